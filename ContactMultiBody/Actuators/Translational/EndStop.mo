within ContactMultiBody.Actuators.Translational;
model EndStop "Elastic stops at both ends of a joint's range"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.Position s_min=-Modelica.Constants.inf "Lower end of the range";
  parameter Modelica.Units.SI.Position s_max=Modelica.Constants.inf "Upper end of the range";
  parameter Modelica.Units.SI.TranslationalSpringConstant c(min=0)=1e4 "Stiffness of the stops";
  parameter Real damping(min=0, unit="s/m")=0 "Part of the elastic force that is added at unit speed inwards";
  Modelica.Units.SI.Position depth "How far a stop is pressed in, zero inside the range";
equation
  depth = noEvent(if s > s_max then s - s_max elseif s < s_min then s_min - s else 0);
  f = noEvent(
    if s > s_max then -c*depth*max(0, 1 + damping*v)
    elseif s < s_min then c*depth*max(0, 1 - damping*v) else 0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-15},{60,-15}}, color={128,128,128}), Line(points={{-10,45},{-10,-75}}, color={128,128,128}),
        Line(points={{-75,-70},{-50,-15},{30,-15},{55,40}}, color={0,127,0}, thickness=0.5)}),
    Documentation(info="<html>
<p>
Inside the range nothing acts. Beyond an end by the depth x the stop pushes back with
<code>c*x*max(0, 1 + damping*der(x))</code>: continuous at every speed, and never pulling. Energy is lost in each blow, and with
<code>damping = 0</code> none.
</p>
</html>"));
end EndStop;
