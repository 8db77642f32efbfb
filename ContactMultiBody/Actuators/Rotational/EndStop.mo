within ContactMultiBody.Actuators.Rotational;
model EndStop "Elastic stops at both ends of a joint's range"
  extends Interfaces.PartialRotationalDrive;
  parameter Modelica.Units.SI.Angle phi_min=-Modelica.Constants.inf "Lower end of the range";
  parameter Modelica.Units.SI.Angle phi_max=Modelica.Constants.inf "Upper end of the range";
  parameter Modelica.Units.SI.RotationalSpringConstant c(min=0)=1e4 "Stiffness of the stops";
  parameter Real damping(min=0, unit="s/rad")=0 "Part of the elastic torque that is added at unit speed inwards";
  Modelica.Units.SI.Angle depth "How far a stop is pressed in, zero inside the range";
equation
  depth = noEvent(if phi > phi_max then phi - phi_max elseif phi < phi_min then phi_min - phi else 0);
  tau = noEvent(
    if phi > phi_max then -c*depth*max(0, 1 + damping*w)
    elseif phi < phi_min then c*depth*max(0, 1 - damping*w) else 0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-15},{60,-15}}, color={128,128,128}), Line(points={{-10,45},{-10,-75}}, color={128,128,128}),
        Line(points={{-75,-70},{-50,-15},{30,-15},{55,40}}, color={0,0,0}, thickness=0.5)}),
    Documentation(info="<html>
<p>
Inside the range nothing acts. Beyond an end by the depth x the stop pushes back with
<code>c*x*max(0, 1 + damping*der(x))</code>: continuous at every speed, and never pulling. Energy is lost in each blow, and with
<code>damping = 0</code> none.
</p>
</html>"));
end EndStop;
