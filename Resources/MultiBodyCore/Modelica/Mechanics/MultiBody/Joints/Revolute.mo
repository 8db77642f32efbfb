within Modelica.Mechanics.MultiBody.Joints;
model Revolute "Joint that turns about an axis"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialElementaryJoint;
  import Modelica.Mechanics.MultiBody.Types;
  Modelica.Mechanics.Rotational.Interfaces.Flange_a axis(phi=phi, tau=tau) if useAxisFlange "Flange that turns with frame_b"
    annotation (Placement(transformation(extent={{10,90},{-10,110}})));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b support(phi=0) if useAxisFlange "Flange of the housing, at rest in frame_a"
    annotation (Placement(transformation(extent={{-70,90},{-50,110}})));
  parameter Boolean useAxisFlange=false "= true, if the flanges axis and support exist" annotation (Evaluate=true);
  parameter Boolean animation=true "= true, if a cylinder is shown";
  parameter Types.Axis n={0,0,1} "Axis of rotation, the same in frame_a and frame_b";
  parameter SI.Distance cylinderLength=world.defaultJointLength "Length of the cylinder" annotation (Dialog(tab="Animation"));
  parameter SI.Distance cylinderDiameter=world.defaultJointWidth "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of phi and w as states" annotation (Dialog(tab="Advanced"));
  SI.Angle phi(start=0, final stateSelect=stateSelect) "Angle of the rotation from frame_a to frame_b";
  SI.AngularVelocity w(start=0, stateSelect=stateSelect) "Derivative of phi";
  SI.AngularAcceleration a(start=0) "Derivative of w";
  SI.Torque tau "Driving torque about the axis";
  SI.Angle angle "The same as phi";
protected
  parameter Real e[3](each final unit="1")=Modelica.Math.Vectors.normalizeWithAssert(n) "Axis of rotation, of length 1";
  Frames.Orientation R_rel "Orientation of the frame further from the root with respect to the nearer one";
equation
  angle = phi;
  w = der(phi);
  a = der(w);
  frame_b.r_0 = frame_a.r_0;
  if Connections.rooted(frame_a.R) then
    R_rel = Frames.planarRotation(e, phi, w);
    frame_b.R = Frames.absoluteRotation(frame_a.R, R_rel);
    frame_a.f = -Frames.resolve1(R_rel, frame_b.f);
    frame_a.t = -Frames.resolve1(R_rel, frame_b.t);
  else
    R_rel = Frames.planarRotation(-e, phi, w);
    frame_a.R = Frames.absoluteRotation(frame_b.R, R_rel);
    frame_b.f = -Frames.resolve1(R_rel, frame_a.f);
    frame_b.t = -Frames.resolve1(R_rel, frame_a.t);
  end if;
  tau = -frame_b.t*e;
  if not useAxisFlange then
    tau = 0;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{-30,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{30,60},{100,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-30,12},{30,-12}}, lineColor={70,70,70}, fillColor={120,120,120}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>frame_b turns about the axis <code>n</code>, fixed in both frames, by the angle <code>phi</code>; the origins coincide.
For <code>phi = 0</code> the frames coincide. With <code>useAxisFlange = true</code> a drive train can be connected to
<code>axis</code>, its housing to <code>support</code>; without, the joint turns freely.</p></html>"));
end Revolute;
