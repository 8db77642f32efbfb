within ContactMultiBody.NormalForce;
pure function lankaraniNikravesh "Damping factor of Lankarani and Nikravesh"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 0.75*(1 - restitution^2);
  annotation (Documentation(info="<html>
<p>H. M. Lankarani, P. E. Nikravesh: A contact force model with hysteresis damping for impact analysis of multibody systems. Journal of Mechanical Design 112 (1990): d = 3(1 - e<sup>2</sup>)/4.</p>
</html>"));
end lankaraniNikravesh;
