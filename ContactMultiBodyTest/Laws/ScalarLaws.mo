within ContactMultiBodyTest.Laws;
model ScalarLaws "Force laws, rest damping, friction and stiffness have the values of their formulas"
  extends Modelica.Icons.Example;
  Real pull "Force of a contact that is pulled apart fast";
  Real push "Force at depth 0.01 and approach speed 0.5";
  Real apart "Force without penetration";
  Real fast "Damping rate of an impact faster than the rest speed";
  Real slow "Damping rate of a contact that starts at rest";
  Real dead "Damping rate of a contact that starts at rest and is to give nothing back";
  Real hertz "Stiffness of steel on steel, radius 10 mm";
  Real sliding[3] "Regularised friction at high speed";
  Real muSlow "Coefficient of friction at rest";
  Real muFast "Coefficient of friction while sliding";
  Real spin[3] "Torque against spin";
  Real roll[3] "Torque against rolling";
equation
  pull = ContactMultiBody.NormalForce.normalForce(0.01, -100, 1e4, 1, 0.5);
  push = ContactMultiBody.NormalForce.normalForce(0.01, 0.5, 1e4, 1.5, 0.5);
  apart = ContactMultiBody.NormalForce.normalForce(0, 100, 1e4, 1, 0.5);
  fast = ContactMultiBody.NormalForce.dampingRate(0.6, 2, 0.01);
  slow = ContactMultiBody.NormalForce.dampingRate(0.6, 0, 0.01);
  dead = ContactMultiBody.NormalForce.dampingRate(2000, 1e-3, 0.01);
  hertz = ContactMultiBody.NormalForce.hertzStiffness(210e9, 0.3, 210e9, 0.3, 0.01);
  sliding = ContactMultiBody.Friction.regularised(10, {3,4,0}, 0.5, 1e-6);
  muSlow = ContactMultiBody.Friction.stribeck(0, 0.6, 0.4, 0.01);
  muFast = ContactMultiBody.Friction.stribeck(1, 0.6, 0.4, 0.01);
  spin = ContactMultiBody.Friction.spinTorque(9, {0,0,1}, {5,0,7}, 0.5, 0.1, 1e-9);
  roll = ContactMultiBody.Friction.rollingTorque(9, {0,0,1}, {3,4,7}, 0.1, 1e-9);
  annotation (experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>Variables are compared with the formulas, and their limits.</p>
</html>"));
end ScalarLaws;
