within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function relativeRotation "Quaternion of frame 2 with respect to frame 1 from two absolute ones"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q1 "Absolute quaternion of frame 1";
  input Quaternions.Orientation Q2 "Absolute quaternion of frame 2";
  output Quaternions.Orientation Q_rel "Quaternion of frame 2 with respect to frame 1";
algorithm
  Q_rel := cat(1, Q1[4]*Q2[1:3] - Q2[4]*Q1[1:3] - cross(Q1[1:3], Q2[1:3]), {Q1*Q2});
  annotation (Inline=true, Documentation(info="<html>
<p>The product of the conjugate of <code>Q1</code> and <code>Q2</code>.</p></html>"));
end relativeRotation;
