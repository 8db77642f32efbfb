within Modelica.Mechanics.MultiBody.Joints;
model Planar "Joint that moves in a plane"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if shapes are shown";
  parameter Types.Axis n={0,0,1} "Normal of the plane";
  parameter Types.Axis n_x={1,0,0} "Vector whose part in the plane is the direction of s_x";
  parameter SI.Distance cylinderLength=world.defaultJointLength "Length of the cylinder" annotation (Dialog(tab="Animation"));
  parameter SI.Distance cylinderDiameter=world.defaultJointWidth "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  parameter SI.Distance boxWidth=0.3*cylinderDiameter "Width of the boxes" annotation (Dialog(tab="Animation"));
  parameter SI.Distance boxHeight=boxWidth "Height of the boxes" annotation (Dialog(tab="Animation"));
  input Types.Color boxColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the boxes" annotation (Dialog(tab="Animation"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of the coordinates and their derivatives as states" annotation (Dialog(tab="Advanced"));
  Prismatic prismatic_x(n=cross(cross(n, n_x), n), animation=false, stateSelect=StateSelect.never) "Slides along x";
  Prismatic prismatic_y(n=cross(n, n_x), animation=false, stateSelect=StateSelect.never) "Slides along y";
  Revolute revolute(n=n, animation=false, stateSelect=StateSelect.never) "Turns about the normal";
  SI.Position s_x(start=0, stateSelect=stateSelect) "Distance along x";
  SI.Position s_y(start=0, stateSelect=stateSelect) "Distance along y";
  SI.Angle phi(start=0, stateSelect=stateSelect) "Angle about the normal";
  SI.Velocity v_x(start=0, stateSelect=stateSelect) "Derivative of s_x";
  SI.Velocity v_y(start=0, stateSelect=stateSelect) "Derivative of s_y";
  SI.AngularVelocity w(start=0, stateSelect=stateSelect) "Derivative of phi";
  SI.Acceleration a_x(start=0) "Derivative of v_x";
  SI.Acceleration a_y(start=0) "Derivative of v_y";
  SI.AngularAcceleration wd(start=0) "Derivative of w";
equation
  s_x = prismatic_x.s;
  s_y = prismatic_y.s;
  phi = revolute.phi;
  v_x = der(s_x);
  v_y = der(s_y);
  w = der(phi);
  a_x = der(v_x);
  a_y = der(v_y);
  wd = der(w);
  connect(frame_a, prismatic_x.frame_a);
  connect(prismatic_x.frame_b, prismatic_y.frame_a);
  connect(prismatic_y.frame_b, revolute.frame_a);
  connect(revolute.frame_b, frame_b);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,-40},{60,-40},{100,40},{-60,40},{-100,-40}}, lineColor={70,70,70}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-25,20},{25,-20}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>frame_b slides in the plane of frame_a that has the normal <code>n</code>, and turns about the normal: two Prismatic and a
Revolute in a row.</p></html>"));
end Planar;
