within ContactMultiBody.Materials;
record PTFE "Polytetrafluoroethylene on itself"
  extends Material(
    E=0.5e9,
    nu=0.46,
    restitution=0.4,
    muStatic=0.04,
    muDynamic=0.04,
    density=2200);
  annotation (Documentation(info="<html>
<p>Elasticity and density: common data sheet values of unfilled PTFE. Friction, Teflon on Teflon: R. A. Serway, J. W. Jewett: Physics for Scientists and Engineers, 6th edition, Thomson 2004, table 5.2. The coefficient of restitution is a typical value for impacts of about 1 m/s and depends on shape, speed and hardness; measure it where it matters.</p>
</html>"));
end PTFE;
