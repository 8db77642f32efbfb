within CoreFixtures;
model Controller "PID controller with limits that turns an inertia to an angle"
  extends Modelica.Icons.Example;
  Modelica.Blocks.Sources.Step step(height=1, startTime=0.1);
  Modelica.Blocks.Continuous.LimPID controller(k=20, Ti=0.5, Td=0.2, yMax=4, wd=1);
  Modelica.Mechanics.Rotational.Sources.Torque motor;
  Modelica.Mechanics.Rotational.Components.Inertia inertia(J=0.5, phi(fixed=true, start=0), w(fixed=true, start=0));
  Modelica.Mechanics.Rotational.Sensors.AngleSensor angle;
equation
  connect(step.y, controller.u_s);
  connect(angle.phi, controller.u_m);
  connect(controller.y, motor.tau);
  connect(motor.flange, inertia.flange_a);
  connect(inertia.flange_b, angle.flange);
  annotation (experiment(StopTime=2, Tolerance=1e-9));
end Controller;
