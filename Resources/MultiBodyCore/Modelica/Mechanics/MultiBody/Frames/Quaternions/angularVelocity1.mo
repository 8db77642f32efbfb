within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function angularVelocity1 "Angular velocity in coordinates of frame 1"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input der_Orientation der_Q "Derivative of Q";
  output SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 1";
algorithm
  w := 2*(Q[4]*der_Q[1:3] - der_Q[4]*Q[1:3] + cross(Q[1:3], der_Q[1:3]));
  annotation (Inline=true, Documentation(info="<html>
<p>Twice the vector part of the quaternion product of <code>der_Q</code> and the conjugate of <code>Q</code>.</p></html>"));
end angularVelocity1;
