within Modelica.Mechanics.MultiBody.Visualizers;
model FixedShape "Shape fixed to a frame"
  import Modelica.Mechanics.MultiBody.Types;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialVisualizer;
  parameter Boolean animation=true "= true, if the shape is shown";
  parameter Types.ShapeType shapeType="box" "Kind of shape";
  input SI.Position r_shape[3]={0,0,0} "Position of the shape from the origin of frame_a, in its coordinates";
  input Types.Axis lengthDirection={1,0,0} "Direction of the length";
  input Types.Axis widthDirection={0,1,0} "Direction of the width";
  input SI.Distance length(start=1) "Length";
  input SI.Distance width(start=0.1) "Width";
  input SI.Distance height(start=0.1) "Height";
  input Types.Color color={0,128,255} "Colour";
  input Types.ShapeExtra extra=0.0 "One more number that some shapes need";
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light";
equation
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-70,50},{70,-50}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>Accepted, so that models need no change; without effect.</p></html>"));
end FixedShape;
