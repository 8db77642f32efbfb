within ContactMultiBody.Materials;
record Brass "Brass, friction against steel"
  extends Material(
    E=103e9,
    nu=0.34,
    restitution=0.5,
    muStatic=0.51,
    muDynamic=0.44,
    density=8500);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H, middle of the range. Friction, brass on mild steel: E. A. Avallone, T. Baumeister, A. M. Sadegh (editors): Marks' Standard Handbook for Mechanical Engineers, 11th edition, McGraw-Hill 2007, table 3.2.1. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Brass;
