within ContactMultiBody.Materials;
record CastIron "Cast iron on cast iron, dry"
  extends Material(
    E=125e9,
    nu=0.25,
    restitution=0.5,
    muStatic=1.1,
    muDynamic=0.15,
    density=7200);
  annotation (Documentation(info="<html>
<p>Elasticity and density: J. M. Gere, B. J. Goodno: Mechanics of Materials, 7th edition, Cengage 2009, appendix H, middle of the range. Friction, cast iron on cast iron: E. A. Avallone, T. Baumeister, A. M. Sadegh (editors): Marks' Standard Handbook for Mechanical Engineers, 11th edition, McGraw-Hill 2007, table 3.2.1; the static value is that of clean surfaces. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end CastIron;
