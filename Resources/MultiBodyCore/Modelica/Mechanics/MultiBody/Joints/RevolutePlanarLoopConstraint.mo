within Modelica.Mechanics.MultiBody.Joints;
model RevolutePlanarLoopConstraint "Revolute joint that closes a planar loop"
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_a frame_a "First frame"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if a cylinder is shown";
  parameter Types.Axis n={0,0,1} "Axis of rotation, the same in frame_a and frame_b: the normal of the loop's plane";
  parameter SI.Distance cylinderLength=world.defaultJointLength "Length of the cylinder" annotation (Dialog(tab="Animation"));
  parameter SI.Distance cylinderDiameter=world.defaultJointWidth "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
protected
  outer Modelica.Mechanics.MultiBody.World world;
  parameter Real e[3](each final unit="1")=Modelica.Math.Vectors.normalizeWithAssert(n) "Axis of rotation, of length 1";
  parameter Real e_x[3](each final unit="1")=Modelica.Math.Vectors.normalizeWithAssert(cross(e, if abs(e[1]) < 0.7 then {1.0,0.0,0.0} else {0.0,1.0,0.0}))
    "A direction in the plane, in coordinates of frame_a";
  parameter Real e_y[3](each final unit="1")=cross(e, e_x) "The other direction in the plane, in coordinates of frame_a";
  Frames.Orientation R_rel "Orientation of frame_b with respect to frame_a";
  SI.Position r_rel_a[3] "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  SI.Force f_c[2] "Constraint forces on frame_a along e_x and e_y";
equation
  R_rel = Frames.relativeRotation(frame_a.R, frame_b.R);
  r_rel_a = Frames.resolve2(frame_a.R, frame_b.r_0 - frame_a.r_0);

  // The other joints of the loop keep it in its plane; only the two distances in the plane are left to be zero.
  0 = e_x*r_rel_a;
  0 = e_y*r_rel_a;
  frame_a.f = f_c[1]*e_x + f_c[2]*e_y;
  frame_b.f = -Frames.resolve2(R_rel, frame_a.f);
  zeros(3) = frame_a.t;
  zeros(3) = frame_b.t;
  assert(abs(e*r_rel_a) < 1e-10 and Modelica.Math.Vectors.length(Frames.resolve2(R_rel, e) - e) < 1e-10,
    "RevolutePlanarLoopConstraint: the loop is not planar. The axes n of all revolute joints of the loop must be parallel, and its prismatic joints at right angles to them; use Revolute instead of this joint in a loop that is not planar.");
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{-30,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{30,60},{100,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{-30,12},{30,-12}}, lineColor={180,30,30}, fillColor={220,120,120}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A loop of revolute joints with parallel axes has three equations too many if every joint forbids motion out of the plane.
Replace one of its Revolute joints by this one, which closes the loop in the plane alone: it takes up forces in the plane only.</p></html>"));
end RevolutePlanarLoopConstraint;
