within ContactMultiBody.Actuators.Rotational;
model CascadeServo "Geared motor with a cascade controller: angle, speed, current"
  extends Interfaces.PartialRotationalDrive;
  extends Internal.PartialMotor(
    final useInductance=true,
    u_max=48,
    i_max=20);
  parameter Real ratio(min=Modelica.Constants.small, unit="1")=1 "Gear: speed of the rotor over speed of the flange";
  parameter Modelica.Units.SI.AngularVelocity w_max(min=0)=500 "Largest wanted speed of the rotor"
    annotation (Dialog(group="Limits"));
  parameter Modelica.Units.SI.Inertia J_design(min=Modelica.Constants.small)=2*J + Modelica.Constants.small
    "Moment of inertia at the rotor's shaft, load and all, that the speed loop is laid out for" annotation (Dialog(group="Controller"));
  parameter Modelica.Units.SI.Frequency f_position(min=0)=4 "Bandwidth of the angle loop" annotation (Dialog(group="Controller"));
  parameter Modelica.Units.SI.Frequency f_speed(min=0)=20 "Bandwidth of the speed loop" annotation (Dialog(group="Controller"));
  parameter Modelica.Units.SI.Frequency f_current(min=0)=200 "Bandwidth of the current loop" annotation (Dialog(group="Controller"));
  Modelica.Blocks.Interfaces.RealInput phi_ref(final quantity="Angle", final unit="rad", displayUnit="deg") "Wanted angle"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Controllers.Cascade controller(
    final R=R,
    final L=L,
    final k=k,
    final J=J_design,
    final u_max=u_max,
    final i_max=i_max,
    final w_max=w_max,
    final f_position=f_position,
    final f_speed=f_speed,
    final f_current=f_current) "Loops of position, speed and current, in the rotor's angle"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}})));
equation
  w_motor = ratio*w;
  v_motor = controller.u;
  tau = ratio*tau_motor;
  controller.phi_ref = ratio*phi_ref;
  controller.phi = ratio*phi;
  controller.w = w_motor;
  controller.i = i;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{10,45},{70,-15}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{16,38},{64,-8}}, textColor={0,0,0}, textString="M"),
        Rectangle(extent={{-90,30},{-65,0}}, lineColor={0,0,127}),
        Rectangle(extent={{-57,30},{-32,0}}, lineColor={0,0,127}),
        Rectangle(extent={{-24,30},{1,0}}, lineColor={0,0,127}),
        Line(points={{-65,15},{-57,15}}, color={0,0,127}), Line(points={{-32,15},{-24,15}}, color={0,0,127}), Line(points={{1,15},{10,15}}, color={0,0,127})}),
    Documentation(info="<html>
<p>
<a href=\"modelica://ContactMultiBody.Actuators.Rotational.Motor\">Motor</a> with a
<a href=\"modelica://ContactMultiBody.Actuators.Controllers.Cascade\">cascade controller</a>. The loops follow from the data of the motor and
three bandwidths, each several times that of the loop around it; lay the speed loop out for the load with <code>J_design</code>.
</p>
</html>"));
end CascadeServo;
