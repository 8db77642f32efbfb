within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function to_T_inv "Inverse rotation matrix of a quaternion"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  output Real T_inv[3, 3] "Coordinates in frame 2 to coordinates in frame 1";
algorithm
  T_inv := transpose(to_T(Q));
  annotation (Inline=true, Documentation(info="<html>
<p>The transpose of <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Quaternions.to_T\">to_T</a>.</p></html>"));
end to_T_inv;
