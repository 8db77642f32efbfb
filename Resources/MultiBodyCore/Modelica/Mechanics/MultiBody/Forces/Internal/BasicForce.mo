within Modelica.Mechanics.MultiBody.Forces.Internal;
model BasicForce "Force between two frames from a signal"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB;
  Interfaces.Frame_resolve frame_resolve "Frame the force is resolved in, if resolveInFrame = frame_resolve"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput force[3](each final quantity="Force", each final unit="N") "Force on frame_b"
    annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=270, origin={-60,120})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_b "Frame the force is resolved in";
  SI.Position r_0[3] "Position of frame_b from the origin of frame_a, in coordinates of the world frame";
  SI.Force f_b_0[3] "Cut force at frame_b, in coordinates of the world frame";
equation
  r_0 = frame_b.r_0 - frame_a.r_0;
  if resolveInFrame == ResolveInFrameAB.world then
    f_b_0 = -force;
    frame_b.f = Frames.resolve2(frame_b.R, f_b_0);
  elseif resolveInFrame == ResolveInFrameAB.frame_a then
    f_b_0 = -Frames.resolve1(frame_a.R, force);
    frame_b.f = Frames.resolve2(frame_b.R, f_b_0);
  elseif resolveInFrame == ResolveInFrameAB.frame_b then
    f_b_0 = -Frames.resolve1(frame_b.R, force);
    frame_b.f = -force;
  else
    f_b_0 = -Frames.resolve1(frame_resolve.R, force);
    frame_b.f = Frames.resolve2(frame_b.R, f_b_0);
  end if;
  frame_b.t = zeros(3);
  frame_a.f = -Frames.resolve2(frame_a.R, f_b_0);
  frame_a.t = -Frames.resolve2(frame_a.R, cross(r_0, f_b_0));
  frame_resolve.f = zeros(3);
  frame_resolve.t = zeros(3);
  annotation (Documentation(info="<html><p>The core of Force and ForceAndTorque.</p></html>"));
end BasicForce;
