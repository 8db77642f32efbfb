within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialForce "Force and torque between two frames, given at frame_b"
  extends PartialTwoFrames;
  SI.Position r_rel_b[3] "Position of frame_a from the origin of frame_b, in coordinates of frame_b";
equation
  r_rel_b = Frames.resolve2(frame_b.R, frame_a.r_0 - frame_b.r_0);
  frame_a.f = -Frames.resolveRelative(frame_b.f, frame_b.R, frame_a.R);
  frame_a.t = -Frames.resolveRelative(frame_b.t - cross(r_rel_b, frame_b.f), frame_b.R, frame_a.R);
  annotation (Documentation(info="<html>
<p>Base class of force elements: the force and torque at frame_a keep those at frame_b in balance.
Classes that extend it give <code>frame_b.f</code> and <code>frame_b.t</code>.</p></html>"));
end PartialForce;
