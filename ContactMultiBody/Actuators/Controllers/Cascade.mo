within ContactMultiBody.Actuators.Controllers;
block Cascade "Loops of position, speed and current of a direct-current motor"
  extends Modelica.Blocks.Icons.Block;
  parameter Modelica.Units.SI.Resistance R(min=Modelica.Constants.small)=1 "Resistance of the winding" annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.Inductance L(min=Modelica.Constants.small)=1e-3 "Inductance of the winding" annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.ElectricalTorqueConstant k(min=Modelica.Constants.small)=0.05 "Torque over current" annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.Inertia J(min=Modelica.Constants.small)=2e-5 "Moment of inertia at the rotor's shaft, load and all"
    annotation (Dialog(group="Motor"));
  parameter Modelica.Units.SI.Voltage u_max(min=0)=48 "Largest voltage" annotation (Dialog(group="Limits"));
  parameter Modelica.Units.SI.Current i_max(min=0)=20 "Largest current" annotation (Dialog(group="Limits"));
  parameter Modelica.Units.SI.AngularVelocity w_max(min=0)=500 "Largest wanted speed" annotation (Dialog(group="Limits"));
  parameter Modelica.Units.SI.Frequency f_position(min=0)=4 "Bandwidth of the position loop" annotation (Dialog(group="Loops"));
  parameter Modelica.Units.SI.Frequency f_speed(min=0)=20 "Bandwidth of the speed loop" annotation (Dialog(group="Loops"));
  parameter Modelica.Units.SI.Frequency f_current(min=0)=200 "Bandwidth of the current loop" annotation (Dialog(group="Loops"));
  Modelica.Blocks.Interfaces.RealInput phi_ref(final quantity="Angle", final unit="rad") "Wanted angle of the rotor"
    annotation (Placement(transformation(extent={{-140,60},{-100,100}})));
  Modelica.Blocks.Interfaces.RealInput phi(final quantity="Angle", final unit="rad") "Angle of the rotor"
    annotation (Placement(transformation(extent={{-140,10},{-100,50}})));
  Modelica.Blocks.Interfaces.RealInput w(final quantity="AngularVelocity", final unit="rad/s") "Speed of the rotor"
    annotation (Placement(transformation(extent={{-140,-50},{-100,-10}})));
  Modelica.Blocks.Interfaces.RealInput i(final quantity="ElectricCurrent", final unit="A") "Current of the motor"
    annotation (Placement(transformation(extent={{-140,-100},{-100,-60}})));
  Modelica.Blocks.Interfaces.RealOutput u(final quantity="ElectricPotential", final unit="V") "Voltage for the motor"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Modelica.Units.SI.AngularVelocity w_ref "Wanted speed";
  Modelica.Units.SI.Current i_ref "Wanted current";
  Modelica.Units.SI.Current i_integral(start=0, fixed=true) "Integral part of the speed loop";
  Modelica.Units.SI.Voltage u_integral(start=0, fixed=true) "Integral part of the current loop";
protected
  constant Real ratio(unit="1")=4 "Corner of the speed loop's integral part: its bandwidth over this";
  final parameter Modelica.Units.SI.AngularFrequency w_position=2*Modelica.Constants.pi*f_position "Gain of the position loop";
  final parameter Modelica.Units.SI.AngularFrequency w_speed=2*Modelica.Constants.pi*f_speed "Bandwidth of the speed loop";
  final parameter Modelica.Units.SI.AngularFrequency w_current=2*Modelica.Constants.pi*f_current "Bandwidth of the current loop";
  Modelica.Units.SI.Current i_wanted "Wanted current before its limit";
  Modelica.Units.SI.Voltage u_wanted "Voltage before its limit";
equation
  w_ref = Internal.limited(w_position*(phi_ref - phi), w_max);
  i_wanted = J*w_speed/k*(w_ref - w) + i_integral;
  i_ref = Internal.limited(i_wanted, i_max);
  // What the limit cuts off is taken back from the integral part, with the time constant of the loop.
  der(i_integral) = J*w_speed/k*(w_speed/ratio)*(w_ref - w) - w_speed*(i_wanted - i_ref);
  u_wanted = L*w_current*(i_ref - i) + u_integral + k*w;
  u = Internal.limited(u_wanted, u_max);
  der(u_integral) = R*w_current*(i_ref - i) - w_current*(u_wanted - u);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,20},{-40,-20}}, lineColor={0,0,127}), Rectangle(extent={{-20,20},{20,-20}}, lineColor={0,0,127}), Rectangle(extent={{40,20},{80,-20}}, lineColor={0,0,127}),
        Line(points={{-40,0},{-20,0}}, color={0,0,127}), Line(points={{20,0},{40,0}}, color={0,0,127}),
        Text(extent={{-76,16},{-44,-16}}, textColor={0,0,127}, textString="P"), Text(extent={{-16,16},{16,-16}}, textColor={0,0,127}, textString="PI"),
        Text(extent={{44,16},{76,-16}}, textColor={0,0,127}, textString="PI")}),
    Documentation(info="<html>
<p>
From the outside in:
</p>
<ul>
<li>position, proportional: <code>w_ref = w_position*(phi_ref - phi)</code>, limited to <code>w_max</code>;</li>
<li>speed, proportional and integral: gain <code>J*w_speed/k</code>, corner <code>w_speed/4</code>, limited to <code>i_max</code>;</li>
<li>current, proportional and integral: gain <code>L*w_current</code>, corner R/L, which cancels the winding's pole; the voltage
<code>k*w</code> that the turning rotor induces is added. So the current follows as a first-order lag with <code>w_current</code>.</li>
</ul>
<p>
with <code>w_... = 2*pi*f_...</code>. What a limit cuts off is taken back from the integral parts (no wind-up).
</p>
</html>"));
end Cascade;
