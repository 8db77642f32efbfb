within ContactMultiBody.Actuators.Rotational;
model Servo "Angle held by a spring and a damper of a controller (PD)"
  extends Interfaces.PartialRotationalDrive;
  parameter Modelica.Units.SI.RotationalSpringConstant c(min=0)=100 "Gain of the angle: torque over deviation";
  parameter Modelica.Units.SI.RotationalDampingConstant d(min=0)=10 "Gain of the speed: torque over deviation";
  parameter Modelica.Units.SI.Torque tau_max(min=0)=Modelica.Constants.inf "Largest torque";
  parameter Boolean useSpeedReference=false "= true, if there is an input of the wanted speed, else it is zero" annotation (Evaluate=true, choices(checkBox=true));
  Modelica.Blocks.Interfaces.RealInput phi_ref(final quantity="Angle", final unit="rad", displayUnit="deg") "Wanted angle"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput w_ref(final quantity="AngularVelocity", final unit="rad/s") if useSpeedReference "Wanted speed"
    annotation (Placement(transformation(extent={{-140,-80},{-100,-40}})));
protected
  Modelica.Blocks.Interfaces.RealInput w_wanted(final quantity="AngularVelocity", final unit="rad/s") "Wanted speed, zero without an input";
equation
  connect(w_ref, w_wanted);
  if not useSpeedReference then
    w_wanted = 0;
  end if;
  tau = Internal.limited(c*(phi_ref - phi) + d*(w_wanted - w), tau_max);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-70,-60},{-55,-60},{-40,50},{-15,-5},{5,25},{25,12},{40,15}}, color={0,0,127}, smooth=Smooth.Bezier, thickness=0.5),
        Text(extent={{-80,-55},{60,-85}}, textColor={0,0,127}, textString="PD")}),
    Documentation(info="<html>
<p>
<code>tau = c*(phi_ref - phi) + d*(w_ref - w)</code>, cut off at &plusmn;<code>tau_max</code>. A moment of inertia J on the flange
answers a step as an oscillator with the angular frequency sqrt(c/J) and the damping ratio d/(2 sqrt(c J)).
</p>
</html>"));
end Servo;
