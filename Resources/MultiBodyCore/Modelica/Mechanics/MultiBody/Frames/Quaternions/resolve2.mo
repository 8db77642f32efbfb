within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function resolve2 "Coordinates in frame 2 of a vector given in frame 1"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input Real v1[3] "Coordinates in frame 1";
  output Real v2[3] "Coordinates in frame 2";
algorithm
  v2 := v1 - 2*cross(Q[1:3], Q[4]*v1 - cross(Q[1:3], v1));
  annotation (Inline=true, Documentation(info="<html>
<p>The vector part of the product <code>conjugate(Q)*v1*Q</code> for a quaternion of length 1.</p></html>"));
end resolve2;
