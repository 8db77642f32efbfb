within Modelica.Mechanics.MultiBody.Forces.Internal;
model BasicTorque "Torque between two frames from a signal"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB;
  Interfaces.Frame_resolve frame_resolve "Frame the torque is resolved in, if resolveInFrame = frame_resolve"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput torque[3](each final quantity="Torque", each final unit="N.m") "Torque on frame_b"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=270, origin={-60,120})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_b "Frame the torque is resolved in";
  SI.Position r_0[3] "Position of frame_b from the origin of frame_a, in coordinates of the world frame";
  SI.Torque t_b_0[3] "Cut torque at frame_b, in coordinates of the world frame";
equation
  r_0 = frame_b.r_0 - frame_a.r_0;
  if resolveInFrame == ResolveInFrameAB.world then
    t_b_0 = -torque;
    frame_b.t = Frames.resolve2(frame_b.R, t_b_0);
  elseif resolveInFrame == ResolveInFrameAB.frame_a then
    t_b_0 = -Frames.resolve1(frame_a.R, torque);
    frame_b.t = Frames.resolve2(frame_b.R, t_b_0);
  elseif resolveInFrame == ResolveInFrameAB.frame_b then
    t_b_0 = -Frames.resolve1(frame_b.R, torque);
    frame_b.t = -torque;
  else
    t_b_0 = -Frames.resolve1(frame_resolve.R, torque);
    frame_b.t = Frames.resolve2(frame_b.R, t_b_0);
  end if;
  frame_b.f = zeros(3);
  frame_a.f = zeros(3);
  frame_a.t = -Frames.resolve2(frame_a.R, t_b_0);
  frame_resolve.f = zeros(3);
  frame_resolve.t = zeros(3);
  annotation (Documentation(info="<html><p>The core of Torque and ForceAndTorque.</p></html>"));
end BasicTorque;
