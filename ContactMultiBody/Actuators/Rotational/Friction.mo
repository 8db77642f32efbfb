within ContactMultiBody.Actuators.Rotational;
model Friction "Viscous and dry friction in a joint"
  extends Interfaces.PartialRotationalDrive;
  parameter Modelica.Units.SI.RotationalDampingConstant d(min=0)=0 "Viscous friction: torque over speed";
  parameter Modelica.Units.SI.Torque tau_dry(min=0)=0 "Dry friction: largest torque";
  parameter Modelica.Units.SI.AngularVelocity w_small(min=Modelica.Constants.small)=0.01 "Speed up to which dry friction grows";
equation
  tau = -d*w - tau_dry*tanh(w/w_small);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-15},{60,-15}}, color={128,128,128}), Line(points={{-10,45},{-10,-75}}, color={128,128,128}),
        Line(points={{-80,-60},{-15,-50},{-5,20},{60,30}}, color={0,0,0}, thickness=0.5)}),
    Documentation(info="<html>
<p>
<code>tau = -d*w - tau_dry*tanh(w/w_small)</code>. Dry friction without states or events: at rest it lets the joint creep
with at most <code>w_small*atanh(x)</code> under a load that is the fraction x of <code>tau_dry</code>.
</p>
</html>"));
end Friction;
