within Modelica.Mechanics.MultiBody.Frames;
function to_exy "x- and y-axis of frame 2"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output Real exy[3, 2] "Columns: unit vectors of x- and y-axis of frame 2 in coordinates of frame 1";
algorithm
  exy := transpose(R.T[1:2, :]);
  annotation (Inline=true, Documentation(info="<html>
<p>Two axes say all about a frame.</p></html>"));
end to_exy;
