within Modelica.Mechanics.MultiBody.Frames;
function from_T "Orientation from a rotation matrix and an angular velocity"
  extends Modelica.Icons.Function;
  input Real T[3, 3] "Rotation matrix, coordinates in frame 1 to coordinates in frame 2";
  input SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 2";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := Orientation(T=T, w=w);
  annotation (Inline=true, Documentation(info="<html>
<p>Puts the two into the record.</p></html>"));
end from_T;
