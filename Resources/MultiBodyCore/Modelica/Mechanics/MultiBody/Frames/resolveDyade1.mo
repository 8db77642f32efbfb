within Modelica.Mechanics.MultiBody.Frames;
function resolveDyade1 "Second-order tensor in coordinates of frame 1"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Real D2[3, 3] "Tensor in coordinates of frame 2";
  output Real D1[3, 3] "Tensor in coordinates of frame 1";
algorithm
  D1 := transpose(R.T)*D2*R.T;
  annotation (Inline=true, Documentation(info="<html>
<p>For example an inertia tensor.</p></html>"));
end resolveDyade1;
