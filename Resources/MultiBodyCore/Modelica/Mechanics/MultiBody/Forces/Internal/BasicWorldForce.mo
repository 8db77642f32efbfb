within Modelica.Mechanics.MultiBody.Forces.Internal;
model BasicWorldForce "Force on frame_b from a signal"
  extends Interfaces.PartialOneFrame_b;
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameB;
  Interfaces.Frame_resolve frame_resolve "Frame the force is resolved in, if resolveInFrame = frame_resolve"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
  Modelica.Blocks.Interfaces.RealInput force[3](each final quantity="Force", each final unit="N") "Force on frame_b"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameB.world "Frame the force is resolved in";
equation
  if resolveInFrame == ResolveInFrameB.world then
    frame_b.f = -Frames.resolve2(frame_b.R, force);
  elseif resolveInFrame == ResolveInFrameB.frame_b then
    frame_b.f = -force;
  else
    frame_b.f = -Frames.resolveRelative(force, frame_resolve.R, frame_b.R);
  end if;
  frame_b.t = zeros(3);
  frame_resolve.f = zeros(3);
  frame_resolve.t = zeros(3);
  annotation (Documentation(info="<html><p>The core of WorldForce.</p></html>"));
end BasicWorldForce;
