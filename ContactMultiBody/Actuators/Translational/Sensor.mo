within ContactMultiBody.Actuators.Translational;
model Sensor "Measures position, speed and force between a drive and its joint"
  extends Modelica.Mechanics.Translational.Interfaces.PartialElementaryTwoFlangesAndSupport2;
  Modelica.Blocks.Interfaces.RealOutput s(final quantity="Length", final unit="m") "Position of the flanges less that of the housing"
    annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
  Modelica.Blocks.Interfaces.RealOutput v(final quantity="Velocity", final unit="m/s") "Derivative of s"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
  Modelica.Blocks.Interfaces.RealOutput f(final quantity="Force", final unit="N") "Force that goes through from flange_a to flange_b"
    annotation (Placement(transformation(extent={{100,-90},{120,-70}})));
equation
  flange_a.s = flange_b.s;
  s = flange_b.s - s_support;
  v = der(s);
  f = flange_a.f;
  0 = flange_a.f + flange_b.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={0,127,0}),
        Ellipse(extent={{-60,60},{60,-60}}, lineColor={0,127,0}, fillColor={245,245,245}, fillPattern=FillPattern.Solid),
        Line(points={{0,-20},{25,30}}, color={0,127,0}, thickness=0.5),
        Ellipse(extent={{-6,-14},{6,-26}}, lineColor={0,127,0}, fillColor={0,127,0}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,140},{150,100}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
Stands between a drive (<code>flange_a</code>) and the joint's axis (<code>flange_b</code>). Without a drive at <code>flange_a</code> it measures
position and speed alone.
</p>
</html>"));
end Sensor;
