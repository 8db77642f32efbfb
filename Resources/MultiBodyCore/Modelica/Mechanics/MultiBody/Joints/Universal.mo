within Modelica.Mechanics.MultiBody.Joints;
model Universal "Joint that turns about two axes, one after the other"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if cylinders are shown";
  parameter Types.Axis n_a={1,0,0} "First axis, fixed in frame_a";
  parameter Types.Axis n_b={0,1,0} "Second axis, fixed in frame_b";
  parameter SI.Distance cylinderLength=world.defaultJointLength "Length of the cylinder" annotation (Dialog(tab="Animation"));
  parameter SI.Distance cylinderDiameter=world.defaultJointWidth "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of the angles and their derivatives as states" annotation (Dialog(tab="Advanced"));
  Revolute revolute_a(n=n_a, stateSelect=StateSelect.never, cylinderDiameter=cylinderDiameter, cylinderLength=cylinderLength,
    cylinderColor=cylinderColor, specularCoefficient=specularCoefficient, animation=animation) "Turns about the first axis";
  Revolute revolute_b(n=n_b, stateSelect=StateSelect.never, cylinderDiameter=cylinderDiameter, cylinderLength=cylinderLength,
    cylinderColor=cylinderColor, specularCoefficient=specularCoefficient, animation=animation) "Turns about the second axis";
  SI.Angle phi_a(start=0, stateSelect=stateSelect) "Angle about the first axis";
  SI.Angle phi_b(start=0, stateSelect=stateSelect) "Angle about the second axis";
  SI.AngularVelocity w_a(start=0, stateSelect=stateSelect) "Derivative of phi_a";
  SI.AngularVelocity w_b(start=0, stateSelect=stateSelect) "Derivative of phi_b";
  SI.AngularAcceleration a_a(start=0) "Derivative of w_a";
  SI.AngularAcceleration a_b(start=0) "Derivative of w_b";
equation
  phi_a = revolute_a.phi;
  phi_b = revolute_b.phi;
  w_a = der(phi_a);
  w_b = der(phi_b);
  a_a = der(w_a);
  a_b = der(w_b);
  connect(frame_a, revolute_a.frame_a);
  connect(revolute_a.frame_b, revolute_b.frame_a);
  connect(revolute_b.frame_b, frame_b);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-40,0},{-40,60},{20,60}}, color={70,70,70}, thickness=2),
        Line(points={{-40,0},{-40,-60},{20,-60}}, color={70,70,70}, thickness=2),
        Ellipse(extent={{-10,30},{50,-30}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.Sphere),
        Line(points={{50,0},{100,0}}, color={70,70,70}, thickness=2),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A Cardan joint: a Revolute about <code>n_a</code> followed by one about <code>n_b</code>.</p></html>"));
end Universal;
