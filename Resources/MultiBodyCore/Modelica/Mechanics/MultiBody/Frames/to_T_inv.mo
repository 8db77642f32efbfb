within Modelica.Mechanics.MultiBody.Frames;
function to_T_inv "Inverse rotation matrix of an orientation"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output Real T_inv[3, 3] "Coordinates in frame 2 to coordinates in frame 1";
algorithm
  T_inv := transpose(R.T);
  annotation (Inline=true, Documentation(info="<html>
<p>The transpose of the matrix.</p></html>"));
end to_T_inv;
