within ContactMultiBody.Actuators.Translational;
model Servo "Position held by a spring and a damper of a controller (PD)"
  extends Interfaces.PartialTranslationalDrive;
  parameter Modelica.Units.SI.TranslationalSpringConstant c(min=0)=100 "Gain of the position: force over deviation";
  parameter Modelica.Units.SI.TranslationalDampingConstant d(min=0)=10 "Gain of the speed: force over deviation";
  parameter Modelica.Units.SI.Force f_max(min=0)=Modelica.Constants.inf "Largest force";
  parameter Boolean useSpeedReference=false "= true, if there is an input of the wanted speed, else it is zero" annotation (Evaluate=true, choices(checkBox=true));
  Modelica.Blocks.Interfaces.RealInput s_ref(final quantity="Length", final unit="m") "Wanted position"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput v_ref(final quantity="Velocity", final unit="m/s") if useSpeedReference "Wanted speed"
    annotation (Placement(transformation(extent={{-140,-80},{-100,-40}})));
protected
  Modelica.Blocks.Interfaces.RealInput v_wanted(final quantity="Velocity", final unit="m/s") "Wanted speed, zero without an input";
equation
  connect(v_ref, v_wanted);
  if not useSpeedReference then
    v_wanted = 0;
  end if;
  f = Internal.limited(c*(s_ref - s) + d*(v_wanted - v), f_max);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,-60},{-55,-60},{-40,50},{-15,-5},{5,25},{25,12},{40,15}}, color={0,0,127}, smooth=Smooth.Bezier, thickness=0.5),
        Text(extent={{-80,-55},{60,-85}}, textColor={0,0,127}, textString="PD")}),
    Documentation(info="<html>
<p>
<code>f = c*(s_ref - s) + d*(v_ref - v)</code>, cut off at &plusmn;<code>f_max</code>. A mass m on the flange
answers a step as an oscillator with the angular frequency sqrt(c/m) and the damping ratio d/(2 sqrt(c m)).
</p>
</html>"));
end Servo;
