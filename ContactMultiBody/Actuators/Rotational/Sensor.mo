within ContactMultiBody.Actuators.Rotational;
model Sensor "Measures angle, speed and torque between a drive and its joint"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialElementaryTwoFlangesAndSupport2;
  Modelica.Blocks.Interfaces.RealOutput phi(final quantity="Angle", final unit="rad", displayUnit="deg") "Angle of the flanges less that of the housing"
    annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
  Modelica.Blocks.Interfaces.RealOutput w(final quantity="AngularVelocity", final unit="rad/s") "Derivative of phi"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
  Modelica.Blocks.Interfaces.RealOutput tau(final quantity="Torque", final unit="N.m") "Torque that goes through from flange_a to flange_b"
    annotation (Placement(transformation(extent={{100,-90},{120,-70}})));
equation
  flange_a.phi = flange_b.phi;
  phi = flange_b.phi - phi_support;
  w = der(phi);
  tau = flange_a.tau;
  0 = flange_a.tau + flange_b.tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={0,0,0}),
        Ellipse(extent={{-60,60},{60,-60}}, lineColor={0,0,0}, fillColor={245,245,245}, fillPattern=FillPattern.Solid),
        Line(points={{0,-20},{25,30}}, color={0,0,0}, thickness=0.5),
        Ellipse(extent={{-6,-14},{6,-26}}, lineColor={0,0,0}, fillColor={0,0,0}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,140},{150,100}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
Stands between a drive (<code>flange_a</code>) and the joint's axis (<code>flange_b</code>). Without a drive at <code>flange_a</code> it measures
angle and speed alone.
</p>
</html>"));
end Sensor;
