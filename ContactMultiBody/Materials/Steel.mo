within ContactMultiBody.Materials;
record Steel "Steel on steel, dry"
  extends Material(
    E=210e9,
    nu=0.3,
    restitution=0.56,
    muStatic=0.74,
    muDynamic=0.57,
    density=7850);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H. Friction, steel on steel: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. Restitution: I. Newton, Principia, 1687, scholium to the laws of motion (5/9).</p>
</html>"));
end Steel;
