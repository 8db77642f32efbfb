within ContactMultiBody.Interfaces;
partial model PartialTurningFriction "Friction against spin and rolling"
  import SI = Modelica.Units.SI;
  extends PartialFriction;

  parameter Boolean useTurningFriction=false "= true, if torques act against spin and rolling"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(group="Spin and rolling friction"));
  parameter SI.Radius spinRadius[m](each min=0)=fill(0, m) "Radius of each pair's area of contact; 0: no spin friction"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));
  parameter SI.Length rollingLever[m](each min=0)=fill(0, m) "Coefficient of rolling friction of each pair, a length; 0: none"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));
  parameter SI.AngularVelocity turningRegularisationSpeed(min=Modelica.Constants.small)=1e-2
    "Angular speed over which torques of friction change their direction"
    annotation (Dialog(group="Spin and rolling friction", enable=useTurningFriction));

protected
  SI.Torque turningTorque[if useTurningFriction then n else 0, 3] "Torque of turning friction on each body, in world axes";
equation
  if useTurningFriction then
    turningTorque = Internal.FrictionForces.turningTorques(
      pointNormalForce,
      normal,
      w_0,
      pair,
      muDynamic,
      spinRadius,
      rollingLever,
      turningRegularisationSpeed);
  end if;
  annotation (Documentation(info="<html>
<p>
Torques of <a href=\"modelica://ContactMultiBody.Friction.spinTorque\">spinTorque</a> and
<a href=\"modelica://ContactMultiBody.Friction.rollingTorque\">rollingTorque</a> at every point; they are there only where they are asked for.
</p>
</html>"));
end PartialTurningFriction;
