within Modelica.Mechanics.MultiBody.Forces;
model WorldForceAndTorque "Force and torque on a frame from the world"
  extends Interfaces.PartialOneFrame_b;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameB;
  Interfaces.Frame_resolve frame_resolve if resolveInFrame == ResolveInFrameB.frame_resolve "Frame force and torque are resolved in"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput force[3](each final quantity="Force", each final unit="N") "Force on frame_b"
    annotation (Placement(transformation(extent={{-140,-80},{-100,-40}})));
  Modelica.Blocks.Interfaces.RealInput torque[3](each final quantity="Torque", each final unit="N.m") "Torque on frame_b"
    annotation (Placement(transformation(extent={{-140,40},{-100,80}})));
  parameter Boolean animation=true "= true, if force and torque are shown";
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameB.world "Frame force and torque are resolved in";
  input Types.Color forceColor=Modelica.Mechanics.MultiBody.Types.Defaults.ForceColor "Colour of the arrow of the force" annotation (Dialog(tab="Animation"));
  input Types.Color torqueColor=Modelica.Mechanics.MultiBody.Types.Defaults.TorqueColor "Colour of the arrow of the torque" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  Internal.BasicWorldForce basicWorldForce(resolveInFrame=resolveInFrame) "Computes the force";
  Internal.BasicWorldTorque basicWorldTorque(resolveInFrame=resolveInFrame) "Computes the torque";
protected
  Interfaces.ZeroPosition zeroPosition if not resolveInFrame == ResolveInFrameB.frame_resolve "Unused frame";
equation
  connect(basicWorldForce.frame_b, frame_b);
  connect(basicWorldTorque.frame_b, frame_b);
  connect(force, basicWorldForce.force);
  connect(torque, basicWorldTorque.torque);
  connect(basicWorldForce.frame_resolve, frame_resolve);
  connect(basicWorldTorque.frame_resolve, frame_resolve);
  connect(zeroPosition.frame_resolve, basicWorldForce.frame_resolve);
  connect(zeroPosition.frame_resolve, basicWorldTorque.frame_resolve);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,-30},{84,-6}}, color={0,128,0}, thickness=2, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-100,30},{84,6}}, color={0,128,0}, thickness=2, arrow={Arrow.None,Arrow.Filled}),
        Ellipse(extent={{-20,50},{20,-10}}, lineColor={0,128,0}),
        Text(extent={{-150,95},{150,60}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The signals of <code>force</code> and <code>torque</code> act on the body frame_b is fixed to, the force at the origin
of frame_b. They are resolved in the world frame, in frame_b, or in the frame connected to <code>frame_resolve</code>.</p></html>"));
end WorldForceAndTorque;
