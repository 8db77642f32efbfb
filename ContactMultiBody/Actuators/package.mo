within ContactMultiBody;
package Actuators "Drives of joints, with and without their controllers"
  extends Modelica.Icons.Package;

  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,40},{30,-60}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{30,0},{80,-20}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid),
        Text(extent={{-60,30},{20,-50}}, textString="M")}),
    Documentation(info="<html>
<p>
What drives, brakes, stops and measures a joint. <a href=\"modelica://ContactMultiBody.Actuators.Rotational\">Rotational</a> is for revolute,
<a href=\"modelica://ContactMultiBody.Actuators.Translational\">Translational</a> for prismatic joints.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>Component</th><th>Input</th><th>What it does</th></tr>
<tr><td>Position</td><td>angle, position</td><td>moves the joint after the filtered signal, whatever it takes</td></tr>
<tr><td>Torque, Force</td><td>torque, force</td><td>for a controller outside</td></tr>
<tr><td>Servo</td><td>angle, position</td><td>PD controller with a limit</td></tr>
<tr><td>Motor, SpindleMotor</td><td>voltage</td><td>direct-current motor with gear or spindle, friction, limits of voltage and current</td></tr>
<tr><td>CascadeServo</td><td>angle, position</td><td>motor with loops of position, speed and current</td></tr>
<tr><td>SpringDamper, Friction, EndStop</td><td>none</td><td>passive</td></tr>
<tr><td>Sensor</td><td>none</td><td>angle or position, speed, torque or force</td></tr>
</table>
<p>
All drives also have angle (position), speed and torque (force) as outputs.
</p>
</html>"));
end Actuators;
