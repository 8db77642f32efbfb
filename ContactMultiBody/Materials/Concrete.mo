within ContactMultiBody.Materials;
record Concrete "Concrete"
  extends Material(
    E=25e9,
    nu=0.2,
    restitution=0.2,
    muStatic=0.6,
    muDynamic=0.6,
    density=2300);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H. Friction: ACI 318, shear friction of concrete against hardened concrete that is not roughened. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Concrete;
