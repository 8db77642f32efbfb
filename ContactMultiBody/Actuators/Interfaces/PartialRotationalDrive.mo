within ContactMultiBody.Actuators.Interfaces;
partial model PartialRotationalDrive "Drive between a flange and its housing that tells angle, speed and torque"
  parameter Boolean useSupport=false "= true, if the housing has a connector, else it stands still" annotation (Evaluate=true, choices(checkBox=true));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange "To the joint's axis" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Modelica.Mechanics.Rotational.Interfaces.Support support(phi=phi_support, tau=-flange.tau) if useSupport "Housing, to the joint's support"
    annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
  Modelica.Blocks.Interfaces.RealOutput phi(final quantity="Angle", final unit="rad", displayUnit="deg")
    "Angle of the flange less that of the housing" annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
  Modelica.Blocks.Interfaces.RealOutput w(final quantity="AngularVelocity", final unit="rad/s") "Derivative of phi"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
  Modelica.Blocks.Interfaces.RealOutput tau(final quantity="Torque", final unit="N.m") "Torque that drives the flange"
    annotation (Placement(transformation(extent={{100,-90},{120,-70}})));
protected
  Modelica.Units.SI.Angle phi_support "Angle of the housing";
equation
  if not useSupport then
    phi_support = 0;
  end if;
  phi = flange.phi - phi_support;
  w = der(phi);
  tau = -flange.tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{80,-90}}, lineColor={0,0,0}, fillColor={235,235,235}, fillPattern=FillPattern.Solid, radius=8),
        Rectangle(extent={{80,8},{100,-8}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,140},{150,100}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
Base of the drives of revolute joints. Connect <code>flange</code> to the joint's <code>axis</code>, and, with
<code>useSupport = true</code>, <code>support</code> to the joint's <code>support</code>. The outputs are for a controller outside.
</p>
</html>"));
end PartialRotationalDrive;
