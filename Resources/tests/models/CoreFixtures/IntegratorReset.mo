within CoreFixtures;
model IntegratorReset "Integrator that is set to a value now and then"
  extends Modelica.Icons.Example;
  Modelica.Blocks.Continuous.Integrator integrator(k=1, use_reset=true, use_set=true);
  Modelica.Blocks.Sources.BooleanStep reset(startTime=0.5);
  Modelica.Blocks.Sources.Constant one(k=1);
  Modelica.Blocks.Sources.Constant value(k=0.25);
equation
  connect(one.y, integrator.u);
  connect(reset.y, integrator.reset);
  connect(value.y, integrator.set);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end IntegratorReset;
