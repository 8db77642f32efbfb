within ContactMultiBody.Materials;
record Ice "Ice on ice"
  extends Material(
    E=9.3e9,
    nu=0.33,
    restitution=0.3,
    muStatic=0.1,
    muDynamic=0.03,
    density=917);
  annotation (Documentation(info="<html>
<p>Elasticity: J. J. Petrovic: Mechanical properties of ice and snow. Journal of Materials Science 38 (2003), lower end of the range. Friction, ice on ice: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end Ice;
