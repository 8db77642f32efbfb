within Modelica.Mechanics.MultiBody.Interfaces;
partial model LineForceBase "Force along the line between two frames"
  extends PartialTwoFrames;
  parameter SI.Distance s_small=1e-10 "The distance counts as at least this, so that nothing is divided by zero" annotation (Dialog(tab="Advanced"));
  parameter Boolean fixedRotationAtFrame_a=false "= true, if frame_a shall be parallel to the world frame because nothing else turns it"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean fixedRotationAtFrame_b=false "= true, if frame_b shall be parallel to the world frame because nothing else turns it"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  SI.Distance length "Distance of the frames";
  SI.Position s "The same, but at least s_small";
  SI.Position r_rel_0[3] "Position of frame_b from the origin of frame_a, in coordinates of the world frame";
  Real e_rel_0[3](each final unit="1") "Its direction";
equation
  assert(noEvent(length > s_small), "The two ends of a line force coincide: its direction is undefined. Keep them apart, or give a smaller s_small");
  r_rel_0 = frame_b.r_0 - frame_a.r_0;
  length = Modelica.Math.Vectors.length(r_rel_0);
  s = noEvent(if length > s_small then length else s_small);
  e_rel_0 = r_rel_0/s;
  if fixedRotationAtFrame_a then
    Connections.root(frame_a.R);
    frame_a.R = Frames.nullRotation();
  else
    frame_a.t = zeros(3);
  end if;
  if fixedRotationAtFrame_b then
    Connections.root(frame_b.R);
    frame_b.R = Frames.nullRotation();
  else
    frame_b.t = zeros(3);
  end if;
  annotation (Documentation(info="<html><p>Base class of springs and dampers between two points.</p></html>"));
end LineForceBase;
