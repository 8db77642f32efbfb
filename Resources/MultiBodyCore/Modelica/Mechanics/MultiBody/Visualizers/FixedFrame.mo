within Modelica.Mechanics.MultiBody.Visualizers;
model FixedFrame "Axes fixed to a frame"
  import Modelica.Mechanics.MultiBody.Types;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialVisualizer;
  parameter Boolean animation=true "= true, if the axes are shown";
  parameter Boolean showLabels=true "= true, if the axes have labels";
  input SI.Distance length=0.5 "Length of the axes";
  input SI.Distance diameter=length/world.defaultFrameDiameterFraction "Diameter of the axes";
  input Types.Color color_x=Modelica.Mechanics.MultiBody.Types.Defaults.FrameColor "Colour of the x-axis";
  input Types.Color color_y=color_x "Colour of the y-axis";
  input Types.Color color_z=color_x "Colour of the z-axis";
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light";
equation
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-60,-60},{-60,60}}, color={70,70,70}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-60,-60},{60,-60}}, color={70,70,70}, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>Accepted, so that models need no change; without effect.</p></html>"));
end FixedFrame;
