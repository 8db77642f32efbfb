within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function to_T "Rotation matrix of a quaternion"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  output Real T[3, 3] "Coordinates in frame 1 to coordinates in frame 2";
algorithm
  T := ((Q[4]^2 - Q[1:3]*Q[1:3])*identity(3) + 2*outerProduct(Q[1:3], Q[1:3]) - 2*Q[4]*skew(Q[1:3]))/(Q*Q);
  annotation (Inline=true, Documentation(info="<html>
<p>Division by the square of the length makes the matrix orthogonal even if the length of Q is not exactly 1, so that the error of a numerically integrated quaternion does not stretch the space.</p></html>"));
end to_T;
