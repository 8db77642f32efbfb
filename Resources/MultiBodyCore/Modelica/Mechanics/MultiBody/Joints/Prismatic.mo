within Modelica.Mechanics.MultiBody.Joints;
model Prismatic "Joint that slides along an axis"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialElementaryJoint;
  import Modelica.Mechanics.MultiBody.Types;
  Modelica.Mechanics.Translational.Interfaces.Flange_a axis(s=s, f=f) if useAxisFlange "Flange that moves with frame_b"
    annotation (Placement(transformation(extent={{90,50},{70,70}})));
  Modelica.Mechanics.Translational.Interfaces.Flange_b support(s=0) if useAxisFlange "Flange of the housing, at rest in frame_a"
    annotation (Placement(transformation(extent={{-50,50},{-30,70}})));
  parameter Boolean useAxisFlange=false "= true, if the flanges axis and support exist" annotation (Evaluate=true);
  parameter Boolean animation=true "= true, if a box is shown";
  parameter Types.Axis n={1,0,0} "Axis of translation, the same in frame_a and frame_b";
  parameter Types.Axis boxWidthDirection={0,1,0} "Direction of the width of the box" annotation (Dialog(tab="Animation"));
  parameter SI.Distance boxWidth=world.defaultJointWidth "Width of the box" annotation (Dialog(tab="Animation"));
  parameter SI.Distance boxHeight=boxWidth "Height of the box" annotation (Dialog(tab="Animation"));
  input Types.Color boxColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the box" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of s and v as states" annotation (Dialog(tab="Advanced"));
  final parameter Real e[3](each final unit="1")=Modelica.Math.Vectors.normalizeWithAssert(n) "Axis of translation, of length 1";
  SI.Position s(start=0, final stateSelect=stateSelect) "Distance from frame_a to frame_b along the axis";
  SI.Velocity v(start=0, final stateSelect=stateSelect) "Derivative of s";
  SI.Acceleration a(start=0) "Derivative of v";
  SI.Force f "Driving force along the axis";
equation
  v = der(s);
  a = der(v);
  frame_b.r_0 = frame_a.r_0 + Frames.resolve1(frame_a.R, s*e);
  frame_b.R = frame_a.R;
  zeros(3) = frame_a.f + frame_b.f;
  zeros(3) = frame_a.t + frame_b.t + cross(s*e, frame_b.f);
  f = -frame_b.f*e;
  if not useAxisFlange then
    f = 0;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,50},{-20,-50}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-20,25},{100,-25}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>frame_b slides along the axis <code>n</code> of frame_a by <code>s</code> and stays parallel to it. With
<code>useAxisFlange = true</code> a drive train can be connected to <code>axis</code>, its housing to <code>support</code>;
without, the joint slides freely.</p></html>"));
end Prismatic;
