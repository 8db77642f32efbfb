within ContactMultiBody.NormalForce;
pure function huntCrossley "Damping factor of Hunt and Crossley"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 1.5*(1 - restitution);
  annotation (Documentation(info="<html>
<p>K. H. Hunt, F. R. E. Crossley: Coefficient of restitution interpreted as damping in vibroimpact. Journal of Applied Mechanics 42 (1975): d = 3(1 - e)/2, exact for e towards 1.</p>
</html>"));
end huntCrossley;
