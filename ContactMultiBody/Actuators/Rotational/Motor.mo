within ContactMultiBody.Actuators.Rotational;
model Motor "Direct-current motor with a gear, friction, and limits of voltage and current"
  extends Interfaces.PartialRotationalDrive;
  extends Internal.PartialMotor;
  parameter Real ratio(min=Modelica.Constants.small, unit="1")=1 "Gear: speed of the rotor over speed of the flange";
  Modelica.Blocks.Interfaces.RealInput u(final quantity="ElectricPotential", final unit="V") "Voltage"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
equation
  v_motor = u;
  w_motor = ratio*w;
  tau = ratio*tau_motor;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,50},{20,-40}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{-60,40},{10,-30}}, textColor={0,0,0}, textString="M"),
        Rectangle(extent={{25,30},{35,-30}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{40,50},{50,-50}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A motor drives the flange through a stiff gear without losses of its own.
The motor is <a href=\"modelica://ContactMultiBody.Actuators.Internal.PartialMotor\">described at its base class</a>: voltage and current
limits, friction, inertia of the rotor. All torques at the flange are those of the rotor's shaft times <code>ratio</code>, and the
rotor's inertia counts with the square of that.
</p>
<p>
Without load and friction the flange turns with <code>u/(k*ratio)</code>; held fast it has the torque <code>ratio*k*min(u/R, i_max)</code>.
</p>
</html>"));
end Motor;
