within ContactMultiBody.Actuators.Interfaces;
partial model PartialTranslationalDrive "Drive between a flange and its housing that tells position, speed and force"
  parameter Boolean useSupport=false "= true, if the housing has a connector, else it stands still" annotation (Evaluate=true, choices(checkBox=true));
  Modelica.Mechanics.Translational.Interfaces.Flange_b flange "To the joint's axis" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Modelica.Mechanics.Translational.Interfaces.Support support(s=s_support, f=-flange.f) if useSupport "Housing, to the joint's support"
    annotation (Placement(transformation(extent={{-10,-110},{10,-90}})));
  Modelica.Blocks.Interfaces.RealOutput s(final quantity="Length", final unit="m")
    "Position of the flange less that of the housing" annotation (Placement(transformation(extent={{100,-50},{120,-30}})));
  Modelica.Blocks.Interfaces.RealOutput v(final quantity="Velocity", final unit="m/s") "Derivative of s"
    annotation (Placement(transformation(extent={{100,-70},{120,-50}})));
  Modelica.Blocks.Interfaces.RealOutput f(final quantity="Force", final unit="N") "Force that drives the flange"
    annotation (Placement(transformation(extent={{100,-90},{120,-70}})));
protected
  Modelica.Units.SI.Position s_support "Position of the housing";
equation
  if not useSupport then
    s_support = 0;
  end if;
  s = flange.s - s_support;
  v = der(s);
  f = -flange.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{80,-90}}, lineColor={0,127,0}, fillColor={235,235,235}, fillPattern=FillPattern.Solid, radius=8),
        Rectangle(extent={{80,8},{100,-8}}, lineColor={0,127,0}, fillColor={160,160,164}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,140},{150,100}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
Base of the drives of prismatic joints. Connect <code>flange</code> to the joint's <code>axis</code>, and, with
<code>useSupport = true</code>, <code>support</code> to the joint's <code>support</code>. The outputs are for a controller outside.
</p>
</html>"));
end PartialTranslationalDrive;
