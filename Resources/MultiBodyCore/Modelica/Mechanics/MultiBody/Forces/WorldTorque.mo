within Modelica.Mechanics.MultiBody.Forces;
model WorldTorque "Torque on a frame from the world"
  extends Interfaces.PartialOneFrame_b;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameB;
  Interfaces.Frame_resolve frame_resolve if resolveInFrame == ResolveInFrameB.frame_resolve "Frame the torque is resolved in"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput torque[3](each final quantity="Torque", each final unit="N.m") "Torque on frame_b"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  parameter Boolean animation=true "= true, if the torque is shown";
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameB.world "Frame the torque is resolved in";
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.TorqueColor "Colour of the arrow" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  Internal.BasicWorldTorque basicWorldTorque(resolveInFrame=resolveInFrame) "Computes the torque";
protected
  Interfaces.ZeroPosition zeroPosition if not resolveInFrame == ResolveInFrameB.frame_resolve "Unused frame";
equation
  connect(basicWorldTorque.frame_b, frame_b);
  connect(torque, basicWorldTorque.torque);
  connect(basicWorldTorque.frame_resolve, frame_resolve);
  connect(zeroPosition.frame_resolve, basicWorldTorque.frame_resolve);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{84,0}}, color={0,128,0}, thickness=2, arrow={Arrow.None,Arrow.Filled}),
        Ellipse(extent={{-20,30},{20,-30}}, lineColor={0,128,0}),
        Text(extent={{-150,80},{150,45}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The three signals of <code>torque</code> act on the body frame_b is fixed to. They are resolved in the world frame, in
frame_b, or in the frame connected to <code>frame_resolve</code>.</p></html>"));
end WorldTorque;
