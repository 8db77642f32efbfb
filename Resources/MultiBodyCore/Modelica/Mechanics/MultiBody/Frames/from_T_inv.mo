within Modelica.Mechanics.MultiBody.Frames;
function from_T_inv "Orientation from an inverse rotation matrix and an angular velocity"
  extends Modelica.Icons.Function;
  input Real T_inv[3, 3] "Rotation matrix, coordinates in frame 2 to coordinates in frame 1";
  input SI.AngularVelocity w[3] "Angular velocity of frame 1 with respect to frame 2, in coordinates of frame 1";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := Orientation(T=transpose(T_inv), w=-(transpose(T_inv)*w));
  annotation (Inline=true, Documentation(info="<html>
<p>The inverse of the orientation that has T_inv and w.</p></html>"));
end from_T_inv;
