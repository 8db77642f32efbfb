within Modelica.Mechanics.MultiBody.Visualizers.Advanced;
model Shape "Shape anywhere"
  import Modelica.Mechanics.MultiBody.Types;
  import Modelica.Mechanics.MultiBody.Frames;
  parameter Types.ShapeType shapeType="box" "Kind of shape";
  input Frames.Orientation R=Frames.nullRotation() "Orientation of the frame the shape is fixed to";
  input SI.Position r[3]={0,0,0} "Position of the frame the shape is fixed to, in coordinates of the world frame";
  input SI.Position r_shape[3]={0,0,0} "Position of the shape from the origin of that frame, in its coordinates";
  input Real lengthDirection[3](each final unit="1") = {1,0,0} "Direction of the length";
  input Real widthDirection[3](each final unit="1") = {0,1,0} "Direction of the width";
  input SI.Length length=0 "Length";
  input SI.Length width=0 "Width";
  input SI.Length height=0 "Height";
  input Types.ShapeExtra extra=0.0 "One more number that some shapes need";
  input Real color[3]={255,0,0} "Colour";
  input Types.SpecularCoefficient specularCoefficient=0.7 "Reflection of light";
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-70,50},{70,-50}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>Accepted, so that models need no change; without effect.</p></html>"));
end Shape;
