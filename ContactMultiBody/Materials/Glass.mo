within ContactMultiBody.Materials;
record Glass "Glass on glass"
  extends Material(
    E=66e9,
    nu=0.22,
    restitution=0.94,
    muStatic=0.94,
    muDynamic=0.4,
    density=2600);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H, middle of the range. Friction, glass on glass: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. Restitution: I. Newton, Principia, 1687, scholium to the laws of motion (15/16, rounded).</p>
</html>"));
end Glass;
