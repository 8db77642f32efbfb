within Modelica.Mechanics.MultiBody.Frames;
function from_Q "Orientation from a quaternion and an angular velocity"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion";
  input SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 2";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := Orientation(T=Quaternions.to_T(Q), w=w);
  annotation (Inline=true, Documentation(info="<html>
<p>The rotation matrix is orthogonal even if the length of Q is not exactly 1, see <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Quaternions.to_T\">Quaternions.to_T</a>.</p></html>"));
end from_Q;
