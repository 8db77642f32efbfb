within ContactMultiBodyTest.Laws;
model FrictionOfPatch "Anchored friction of four points, for any state"
  extends Modelica.Icons.Example;
  input Modelica.Units.SI.Force normalForce[4] "Normal forces";
  input Real normal[4, 3](each unit="1") "Unit normals";
  input Modelica.Units.SI.Position point[4, 3] "Contact points";
  input Modelica.Units.SI.Velocity velocity[4, 3] "Velocities of the first body against the second";
  input Modelica.Units.SI.Position anchor[6] "Stretch of the patch";
  input Modelica.Units.SI.AngularVelocity w[3] "Mean angular velocity of the bodies";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness(start=1) "Stiffness of the static springs";
  input Real muStatic(unit="1") "Coefficient of static friction";
  input Real muDynamic(unit="1") "Coefficient of sliding friction";
  output Modelica.Units.SI.Force force[4, 3] "Friction forces";
  output Modelica.Units.SI.Velocity anchorRate[6] "Derivative of the stretch";
protected
  Modelica.Units.SI.Force patchForce[4, 3] "Friction forces, as the law gives them";
  Modelica.Units.SI.Velocity patchRate[6] "Derivative of the stretch, as the law gives it";
equation
  force = ContactMultiBody.Internal.Unaliased.vectors(patchForce);
  anchorRate = ContactMultiBody.Internal.Unaliased.vector(patchRate);
  (patchForce,patchRate) = ContactMultiBody.Friction.anchoredPatch(
    normalForce,
    normal,
    point,
    velocity,
    anchor,
    w,
    stiffness,
    muStatic,
    muDynamic,
    0.01,
    1e-3,
    1e-3);
  annotation (experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>The limit speed is 0.01 m/s, damping and relaxation time are 1 ms. Tests set the inputs and read the outputs: the law has no other state.</p>
</html>"));
end FrictionOfPatch;
