within ContactMultiBody.Materials;
record Copper "Copper, friction against steel"
  extends Material(
    E=115e9,
    nu=0.34,
    restitution=0.5,
    muStatic=0.53,
    muDynamic=0.36,
    density=8900);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H, middle of the range. Friction, copper on steel: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Copper;
