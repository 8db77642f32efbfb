within ContactMultiBody.Materials;
record Wood "Wood on wood, across the grain"
  extends Material(
    E=12e9,
    nu=0.3,
    restitution=0.5,
    muStatic=0.4,
    muDynamic=0.2,
    density=560);
  annotation (Documentation(info="<html>
<p>Elasticity and density (Douglas fir): J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H; the Poisson number of wood depends on direction, 0.3 is a middle value. Friction, wood on wood: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2 (static 0.25 to 0.5). The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Wood;
