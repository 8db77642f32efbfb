within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function resolve1 "Coordinates in frame 1 of a vector given in frame 2"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input Real v2[3] "Coordinates in frame 2";
  output Real v1[3] "Coordinates in frame 1";
algorithm
  v1 := v2 + 2*cross(Q[1:3], Q[4]*v2 + cross(Q[1:3], v2));
  annotation (Inline=true, Documentation(info="<html>
<p>The vector part of the product <code>Q*v2*conjugate(Q)</code> for a quaternion of length 1.</p></html>"));
end resolve1;
