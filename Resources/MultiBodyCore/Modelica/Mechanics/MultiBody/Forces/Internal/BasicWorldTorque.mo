within Modelica.Mechanics.MultiBody.Forces.Internal;
model BasicWorldTorque "Torque on frame_b from a signal"
  extends Interfaces.PartialOneFrame_b;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameB;
  Interfaces.Frame_resolve frame_resolve "Frame the torque is resolved in, if resolveInFrame = frame_resolve"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput torque[3](each final quantity="Torque", each final unit="N.m") "Torque on frame_b"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameB.world "Frame the torque is resolved in";
equation
  if resolveInFrame == ResolveInFrameB.world then
    frame_b.t = -Frames.resolve2(frame_b.R, torque);
  elseif resolveInFrame == ResolveInFrameB.frame_b then
    frame_b.t = -torque;
  else
    frame_b.t = -Frames.resolveRelative(torque, frame_resolve.R, frame_b.R);
  end if;
  frame_b.f = zeros(3);
  frame_resolve.f = zeros(3);
  frame_resolve.t = zeros(3);
  annotation (Documentation(info="<html><p>The core of WorldTorque.</p></html>"));
end BasicWorldTorque;
