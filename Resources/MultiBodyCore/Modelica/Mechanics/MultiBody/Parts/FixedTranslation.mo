within Modelica.Mechanics.MultiBody.Parts;
model FixedTranslation "Two parallel frames at a fixed distance"
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_a frame_a "First frame, fixed to the rod"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame, fixed to the rod"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if a shape is shown";
  parameter SI.Position r[3](start={0,0,0}) "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
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
  Connections.branch(frame_a.R, frame_b.R);
  frame_b.r_0 = frame_a.r_0 + Frames.resolve1(frame_a.R, r);
  frame_b.R = frame_a.R;
  zeros(3) = frame_a.f + frame_b.f;
  zeros(3) = frame_a.t + frame_b.t + cross(r, frame_b.f);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,8},{100,-8}}, lineColor={70,70,70}, fillColor={155,155,155}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A rod without mass: frame_b is parallel to frame_a and displaced by <code>r</code>.</p></html>"));
end FixedTranslation;
