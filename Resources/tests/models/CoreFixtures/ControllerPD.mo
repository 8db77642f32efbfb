within CoreFixtures;
model ControllerPD "PD controller with feed forward"
  extends Modelica.Icons.Example;
  Modelica.Blocks.Sources.Sine reference(amplitude=1, f=0.5);
  Modelica.Blocks.Sources.Constant forward(k=0.2);
  Modelica.Blocks.Continuous.LimPID controller(controllerType=Modelica.Blocks.Types.SimpleController.PD, k=5, Ti=0.5, Td=0.2, yMax=4, withFeedForward=true);
  Modelica.Blocks.Continuous.FirstOrder plant(T=0.3, initType=Modelica.Blocks.Types.Init.InitialState);
equation
  connect(reference.y, controller.u_s);
  connect(forward.y, controller.u_ff);
  connect(plant.y, controller.u_m);
  connect(controller.y, plant.u);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end ControllerPD;
