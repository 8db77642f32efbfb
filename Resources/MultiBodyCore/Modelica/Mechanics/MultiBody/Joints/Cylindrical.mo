within Modelica.Mechanics.MultiBody.Joints;
model Cylindrical "Joint that turns about an axis and slides along it"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if a cylinder is shown";
  parameter Types.Axis n={1,0,0} "Axis, the same in frame_a and frame_b";
  parameter SI.Distance cylinderDiameter=world.defaultJointWidth "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of s, v, phi and w as states" annotation (Dialog(tab="Advanced"));
  Prismatic prismatic(n=n, animation=false, stateSelect=StateSelect.never) "Slides";
  Revolute revolute(n=n, animation=false, stateSelect=StateSelect.never) "Turns";
  SI.Position s(start=0, stateSelect=stateSelect) "Distance from frame_a to frame_b along the axis";
  SI.Angle phi(start=0, stateSelect=stateSelect) "Angle of the rotation from frame_a to frame_b";
  SI.Velocity v(start=0, stateSelect=stateSelect) "Derivative of s";
  SI.AngularVelocity w(start=0, stateSelect=stateSelect) "Derivative of phi";
  SI.Acceleration a(start=0) "Derivative of v";
  SI.AngularAcceleration wd(start=0) "Derivative of w";
equation
  s = prismatic.s;
  phi = revolute.phi;
  v = der(s);
  w = der(phi);
  a = der(v);
  wd = der(w);
  connect(frame_a, prismatic.frame_a);
  connect(prismatic.frame_b, revolute.frame_a);
  connect(revolute.frame_b, frame_b);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{-30,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-30,30},{100,-30}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>Two freedoms along one axis: a Prismatic followed by a Revolute.</p></html>"));
end Cylindrical;
