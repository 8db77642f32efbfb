within Modelica.Mechanics.MultiBody.Interfaces;
partial model PartialElementaryJoint "Joint that passes the orientation on from frame_a to frame_b"
  extends PartialTwoFrames;
equation
  Connections.branch(frame_a.R, frame_b.R);
  annotation (Documentation(info="<html>
<p>Base class of joints that compute the orientation of one frame from that of the other.</p></html>"));
end PartialElementaryJoint;
