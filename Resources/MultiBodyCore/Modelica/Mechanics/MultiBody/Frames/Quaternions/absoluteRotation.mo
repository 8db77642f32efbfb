within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function absoluteRotation "Absolute quaternion of frame 2 from that of frame 1 and a relative one"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q1 "Absolute quaternion of frame 1";
  input Quaternions.Orientation Q_rel "Quaternion of frame 2 with respect to frame 1";
  output Quaternions.Orientation Q2 "Absolute quaternion of frame 2";
algorithm
  Q2 := cat(1, Q1[4]*Q_rel[1:3] + Q_rel[4]*Q1[1:3] + cross(Q1[1:3], Q_rel[1:3]), {Q1[4]*Q_rel[4] - Q1[1:3]*Q_rel[1:3]});
  annotation (Inline=true, Documentation(info="<html>
<p>The product of <code>Q1</code> and <code>Q_rel</code>.</p></html>"));
end absoluteRotation;
