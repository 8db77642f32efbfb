within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function inverseRotation "Quaternion of the inverse rotation"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  output Quaternions.Orientation Q_inv "Quaternion of frame 1 with respect to frame 2";
algorithm
  Q_inv := {-Q[1], -Q[2], -Q[3], Q[4]};
  annotation (Inline=true, Documentation(info="<html>
<p>The conjugate.</p></html>"));
end inverseRotation;
