within Modelica.Mechanics.MultiBody.Parts;
model Fixed "Frame at rest"
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_b frame_b "Second frame, fixed to the world"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if a shape is shown";
  parameter SI.Position r[3]={0,0,0} "Position of frame_b, from the origin of the world frame, in its coordinates";
  parameter Types.ShapeType shapeType="cylinder" "Kind of shape" annotation (Dialog(tab="Animation"));
  parameter SI.Position r_shape[3]={0,0,0} "Position of the shape from the origin of frame_a, in its coordinates" annotation (Dialog(tab="Animation"));
  parameter Types.Axis lengthDirection=Modelica.Units.Conversions.to_unit1(r - r_shape) "Direction of the length" annotation (Dialog(tab="Animation"));
  parameter Types.Axis widthDirection={0,1,0} "Direction of the width" annotation (Dialog(tab="Animation"));
  parameter SI.Length length=Modelica.Math.Vectors.length(r - r_shape) "Length" annotation (Dialog(tab="Animation"));
  parameter SI.Distance width=length/world.defaultWidthFraction "Width" annotation (Dialog(tab="Animation"));
  parameter SI.Distance height=width "Height" annotation (Dialog(tab="Animation"));
  parameter Types.ShapeExtra extra=0.0 "One more number that some shapes need" annotation (Dialog(tab="Animation"));
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.RodColor "Colour" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
protected
  outer Modelica.Mechanics.MultiBody.World world;
equation
  Connections.root(frame_b.R);
  frame_b.r_0 = r;
  frame_b.R = Frames.nullRotation();
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{0,0},{84,0}}, color={70,70,70}),
        Line(points={{0,60},{0,-60}}, color={70,70,70}, thickness=1),
        Line(points={{0,60},{-30,30}}, color={70,70,70}),
        Line(points={{0,20},{-30,-10}}, color={70,70,70}),
        Line(points={{0,-20},{-30,-50}}, color={70,70,70}),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>frame_b stands still at the position <code>r</code>, parallel to the world frame.</p></html>"));
end Fixed;
