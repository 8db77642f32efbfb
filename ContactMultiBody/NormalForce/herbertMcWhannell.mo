within ContactMultiBody.NormalForce;
pure function herbertMcWhannell "Damping factor of Herbert and McWhannell"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 6*(1 - restitution)/((2*restitution - 1)^2 + 3);
  annotation (Documentation(info="<html>
<p>R. G. Herbert, D. C. McWhannell: Shape and frequency composition of pulses from an impact pair. Journal of Engineering for Industry 99 (1977): d = 6(1 - e)/((2e - 1)<sup>2</sup> + 3).</p>
</html>"));
end herbertMcWhannell;
