within Modelica.Mechanics.MultiBody.Forces;
model Torque "Torque between two frames"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_resolve frame_resolve if resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_resolve
    "Frame the signals are resolved in" annotation (Placement(transformation(extent={{24,84},{56,116}})));
  Modelica.Blocks.Interfaces.RealInput torque[3](each final quantity="Torque", each final unit="N.m") "Torque on frame_b"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=270, origin={-60,120})));
  parameter Boolean animation=true "= true, if arrows are shown";
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_b "Frame the signals are resolved in";
  input SI.Diameter connectionLineDiameter=world.defaultArrowDiameter "Diameter of the line between the frames" annotation (Dialog(tab="Animation"));
  input Types.Color torqueColor=Modelica.Mechanics.MultiBody.Types.Defaults.TorqueColor "Colour of the arrow of the torque" annotation (Dialog(tab="Animation"));
  input Types.Color connectionLineColor=Modelica.Mechanics.MultiBody.Types.Defaults.SensorColor "Colour of the line between the frames" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  Internal.BasicTorque basicTorque(resolveInFrame=resolveInFrame) "Computes the torque";
protected
  Interfaces.ZeroPosition zeroPosition if not resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_resolve "Unused frame";
equation
  connect(frame_a, basicTorque.frame_a);
  connect(frame_b, basicTorque.frame_b);
  connect(torque, basicTorque.torque);
  connect(frame_resolve, basicTorque.frame_resolve);
  connect(zeroPosition.frame_resolve, basicTorque.frame_resolve);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-10,0}}, color={0,128,0}, thickness=2, arrow={Arrow.Filled,Arrow.None}),
        Line(points={{10,0},{90,0}}, color={0,128,0}, thickness=2, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,-40},{150,-75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The signals <code>torque</code> act on frame_b, their reaction on frame_a.</p></html>"));
end Torque;
