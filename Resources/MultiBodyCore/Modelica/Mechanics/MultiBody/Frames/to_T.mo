within Modelica.Mechanics.MultiBody.Frames;
function to_T "Rotation matrix of an orientation"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output Real T[3, 3] "Coordinates in frame 1 to coordinates in frame 2";
algorithm
  T := R.T;
  annotation (Inline=true, Documentation(info="<html>
<p>The matrix alone.</p></html>"));
end to_T;
