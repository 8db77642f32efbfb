within CoreFixtures;
model RotationalMotions "Prescribed rotations"
  extends Modelica.Icons.Example;
  import Modelica.Mechanics.Rotational;
  Modelica.Blocks.Sources.Sine sine(amplitude=0.4, f=1, phase=0.5);
  Modelica.Blocks.Sources.Constant speedReference(k=3);
  Rotational.Sources.Position exact(exact=true);
  Rotational.Sources.Position filtered(f_crit=20);
  Rotational.Sources.Speed speed(f_crit=10, exact=false);
  Rotational.Sources.Speed exactSpeed(exact=true);
  Rotational.Sources.ConstantSpeed constantSpeed(w_fixed=2, phi(fixed=true, start=0.1));
  Rotational.Components.Inertia inertia[5](each J=0.3);
equation
  exact.phi_ref = 0.2*sin(3*time);
  connect(sine.y, filtered.phi_ref);
  connect(speedReference.y, speed.w_ref);
  exactSpeed.w_ref = 1 + time;
  connect(exact.flange, inertia[1].flange_a);
  connect(filtered.flange, inertia[2].flange_a);
  connect(speed.flange, inertia[3].flange_a);
  connect(exactSpeed.flange, inertia[4].flange_a);
  connect(constantSpeed.flange, inertia[5].flange_a);
  annotation (experiment(StopTime=1, Tolerance=1e-9));
end RotationalMotions;
