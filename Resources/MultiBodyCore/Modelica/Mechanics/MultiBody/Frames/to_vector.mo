within Modelica.Mechanics.MultiBody.Frames;
function to_vector "Elements of the rotation matrix, column by column"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output Real vec[9] "The columns of T, one after the other";
algorithm
  vec := cat(1, R.T[:, 1], R.T[:, 2], R.T[:, 3]);
  annotation (Inline=true, Documentation(info="<html>
<p>The nine elements as a vector.</p></html>"));
end to_vector;
