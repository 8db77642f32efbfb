within Modelica.Mechanics.MultiBody;
model World "World frame and gravity"
  import Modelica.Mechanics.MultiBody.Types;
  import Modelica.Mechanics.MultiBody.Types.GravityTypes;

  Interfaces.Frame_b frame_b "Frame at rest in the origin of the world"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));

  parameter Types.GravityTypes gravityType=GravityTypes.UniformGravity "Kind of gravity";
  parameter SI.Acceleration g=Modelica.Constants.g_n "Acceleration by uniform gravity";
  parameter Types.Axis n={0,-1,0} "Direction of uniform gravity";
  parameter Real mu(unit="m3/s2", min=0) = 3.986004418e14 "Constant of point gravity, that of the earth by default";
  parameter Boolean driveTrainMechanics3D=true "= true, if drive trains act on the bodies that carry them";

  parameter Boolean enableAnimation=true "= true, if shapes are shown" annotation (Dialog(tab="Animation"));
  parameter Boolean animateWorld=true "= true, if the world frame is shown" annotation (Dialog(tab="Animation"));
  parameter Boolean animateGravity=true "= true, if gravity is shown" annotation (Dialog(tab="Animation"));
  parameter Boolean animateGround=false "= true, if the ground is shown" annotation (Dialog(tab="Animation"));
  parameter Types.AxisLabel label1="x" "Label of the horizontal axis of the icon" annotation (Dialog(tab="Animation"));
  parameter Types.AxisLabel label2="y" "Label of the vertical axis of the icon" annotation (Dialog(tab="Animation"));
  parameter SI.Distance axisLength=nominalLength/2 "Length of the axes" annotation (Dialog(tab="Animation"));
  parameter SI.Distance axisDiameter=axisLength/defaultFrameDiameterFraction "Diameter of the axes" annotation (Dialog(tab="Animation"));
  parameter Boolean axisShowLabels=true "= true, if the axes have labels" annotation (Dialog(tab="Animation"));
  input Types.Color axisColor_x=Modelica.Mechanics.MultiBody.Types.Defaults.FrameColor "Colour of the x-axis" annotation (Dialog(tab="Animation"));
  input Types.Color axisColor_y=axisColor_x "Colour of the y-axis" annotation (Dialog(tab="Animation"));
  input Types.Color axisColor_z=axisColor_x "Colour of the z-axis" annotation (Dialog(tab="Animation"));
  parameter SI.Position gravityArrowTail[3]={0,0,0} "Where the arrow of gravity starts" annotation (Dialog(tab="Animation"));
  parameter SI.Length gravityArrowLength=axisLength/2 "Length of the arrow of gravity" annotation (Dialog(tab="Animation"));
  parameter SI.Diameter gravityArrowDiameter=gravityArrowLength/defaultWidthFraction "Diameter of the arrow of gravity" annotation (Dialog(tab="Animation"));
  input Types.Color gravityArrowColor={0,230,0} "Colour of the arrow of gravity" annotation (Dialog(tab="Animation"));
  parameter SI.Diameter gravitySphereDiameter=12742000 "Diameter of the sphere of point gravity, that of the earth by default" annotation (Dialog(tab="Animation"));
  input Types.Color gravitySphereColor={0,230,0} "Colour of the sphere of point gravity" annotation (Dialog(tab="Animation"));
  parameter Types.Axis groundAxis_u=if abs(n[1]) >= 0.99 then {0,1,0} else {1,0,0} "First direction of the ground" annotation (Dialog(tab="Animation"));
  parameter SI.Length groundLength_u=2 "Length of the ground along groundAxis_u" annotation (Dialog(tab="Animation"));
  parameter SI.Length groundLength_v=groundLength_u "Length of the ground across groundAxis_u" annotation (Dialog(tab="Animation"));
  input Types.Color groundColor={200,200,200} "Colour of the ground" annotation (Dialog(tab="Animation"));

  parameter SI.Length nominalLength=1 "Size of the mechanism" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultAxisLength=nominalLength/5 "Length of axes" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultJointLength=nominalLength/10 "Length of joints" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultJointWidth=nominalLength/20 "Width of joints" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultForceLength=nominalLength/10 "Length of force elements" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultForceWidth=nominalLength/20 "Width of force elements" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultBodyDiameter=nominalLength/9 "Diameter of bodies" annotation (Dialog(tab="Animation defaults"));
  parameter Real defaultWidthFraction=20 "Length of a shape by its width" annotation (Dialog(tab="Animation defaults"));
  parameter SI.Length defaultArrowDiameter=nominalLength/40 "Diameter of arrows" annotation (Dialog(tab="Animation defaults"));
  parameter Real defaultFrameDiameterFraction=40 "Length of an axis by its diameter" annotation (Dialog(tab="Animation defaults"));
  parameter Real defaultSpecularCoefficient(min=0) = 0.7 "Reflection of light" annotation (Dialog(tab="Animation defaults"));
  parameter Real defaultN_to_m(unit="N/m", min=0) = 1000 "Force that an arrow of 1 m means" annotation (Dialog(tab="Animation defaults"));
  parameter Real defaultNm_to_m(unit="N.m/m", min=0) = 1000 "Torque that an arrow of 1 m means" annotation (Dialog(tab="Animation defaults"));

  replaceable function gravityAcceleration = Modelica.Mechanics.MultiBody.Forces.Internal.standardGravityAcceleration(
      gravityType=gravityType, g=g*Modelica.Math.Vectors.normalizeWithAssert(n), mu=mu)
    constrainedby Modelica.Mechanics.MultiBody.Interfaces.partialGravityAcceleration "Acceleration by gravity at a position";
equation
  Connections.root(frame_b.R);
  assert(Modelica.Math.Vectors.length(n) > 1e-10, "World: the direction of gravity, n, is the zero vector; give a direction");
  frame_b.r_0 = zeros(3);
  frame_b.R = Frames.nullRotation();
  annotation (
    defaultComponentName="world",
    defaultComponentPrefixes="inner",
    missingInnerMessage="There is no World: add a component 'inner Modelica.Mechanics.MultiBody.World world' to the model.",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={70,70,70}, fillColor={245,245,245}, fillPattern=FillPattern.Solid),
        Line(points={{-70,-60},{-70,60}}, color={70,70,70}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-70,-60},{60,-60}}, color={70,70,70}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{30,50},{30,-30}}, color={0,150,0}, arrow={Arrow.None,Arrow.Filled}, thickness=1),
        Text(extent={{-150,145},{150,110}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The frame all positions and orientations are counted from, and gravity, which every body feels. A model has one World,
declared <code>inner</code> on its top level.</p>
<p>With <code>gravityType = UniformGravity</code> the acceleration is <code>g</code> in the direction <code>n</code> everywhere;
with <code>PointGravity</code> it is <code>mu/r^2</code> towards the origin. The function
<code>gravityAcceleration</code> can be redeclared for any other field. Animation parameters have no effect.</p></html>"));
end World;
