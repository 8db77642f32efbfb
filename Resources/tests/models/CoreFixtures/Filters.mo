within CoreFixtures;
model Filters "Linear elements with states"
  extends Modelica.Icons.Example;
  import Modelica.Blocks;
  Blocks.Sources.Constant one(k=1);
  Blocks.Sources.Sine sine(amplitude=1, f=1);
  Blocks.Continuous.Integrator integrator(k=2, y_start=0.5);
  Blocks.Continuous.Derivative derivative(k=2, T=0.05, initType=Blocks.Types.Init.InitialState);
  Blocks.Continuous.FirstOrder firstOrder(k=2, T=0.3, initType=Blocks.Types.Init.InitialOutput, y_start=0.1);
  Blocks.Continuous.SecondOrder secondOrder(k=2, w=10, D=0.4, initType=Blocks.Types.Init.InitialState);
  Blocks.Continuous.PI pi(k=3, T=0.5, initType=Blocks.Types.Init.InitialState);
  Blocks.Continuous.PID pid(k=3, Ti=0.5, Td=0.1);
  Blocks.Continuous.Der der1;
equation
  connect(one.y, integrator.u);
  connect(sine.y, derivative.u);
  connect(one.y, firstOrder.u);
  connect(one.y, secondOrder.u);
  connect(one.y, pi.u);
  connect(one.y, pid.u);
  connect(sine.y, der1.u);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end Filters;
