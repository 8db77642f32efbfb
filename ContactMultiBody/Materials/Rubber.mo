within ContactMultiBody.Materials;
record Rubber "Rubber, friction against concrete"
  extends Material(
    E=4e6,
    nu=0.49,
    restitution=0.75,
    muStatic=1.0,
    muDynamic=0.8,
    density=1100);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H (upper end of the range for the modulus). Friction, rubber on concrete: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Rubber;
