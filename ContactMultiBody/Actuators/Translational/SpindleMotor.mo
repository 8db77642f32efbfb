within ContactMultiBody.Actuators.Translational;
model SpindleMotor "Direct-current motor with a spindle, friction, and limits of voltage and current"
  extends Interfaces.PartialTranslationalDrive;
  extends Internal.PartialMotor;
  parameter Modelica.Units.SI.Length pitch(min=Modelica.Constants.small)=0.005 "Spindle: way of the flange in one turn of the rotor";
  Modelica.Blocks.Interfaces.RealInput u(final quantity="ElectricPotential", final unit="V") "Voltage"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
equation
  v_motor = u;
  w_motor = (2*Modelica.Constants.pi/pitch)*v;
  f = (2*Modelica.Constants.pi/pitch)*tau_motor;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,50},{20,-40}}, lineColor={0,127,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{-60,40},{10,-30}}, textColor={0,127,0}, textString="M"),
        Rectangle(extent={{20,20},{80,-10}}, lineColor={0,127,0}, fillColor={200,220,200}, fillPattern=FillPattern.HorizontalCylinder), Line(points={{30,-10},{40,20},{50,-10},{60,20},{70,-10}}, color={0,127,0})}),
    Documentation(info="<html>
<p>
A motor drives the flange through a stiff spindle without losses of its own.
The motor is <a href=\"modelica://ContactMultiBody.Actuators.Internal.PartialMotor\">described at its base class</a>: voltage and current
limits, friction, inertia of the rotor. All forces at the flange are those of the rotor's shaft times <code>(2*Modelica.Constants.pi/pitch)</code>, and the
rotor's inertia counts with the square of that.
</p>
<p>
Without load and friction the flange moves with <code>u*pitch/(2*pi*k)</code>; held fast it has the force <code>2*pi/pitch*k*min(u/R, i_max)</code>.
</p>
</html>"));
end SpindleMotor;
