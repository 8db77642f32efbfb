within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialLineForce "Force along the line between two frames, without mass"
  extends LineForceBase;
  SI.Position r_rel_a[3] "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  Real e_a[3](each final unit="1") "Its direction";
  SI.Force f "Force that pulls the ends together; negative if it pushes them apart";
equation
  r_rel_a = Frames.resolve2(frame_a.R, r_rel_0);
  e_a = r_rel_a/s;
  frame_a.f = -f*e_a;
  frame_b.f = Frames.resolve2(frame_b.R, f*e_rel_0);
  annotation (Documentation(info="<html><p>Base class of springs and dampers without mass. They give <code>f</code>.</p></html>"));
end PartialLineForce;
