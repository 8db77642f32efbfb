within Modelica.Mechanics.MultiBody.Frames;
function angularVelocity1 "Angular velocity in coordinates of frame 1"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 1";
algorithm
  w := transpose(R.T)*R.w;
  annotation (Inline=true, Documentation(info="<html>
<p>Angular velocity of frame 2 with respect to frame 1, resolved in frame 1.</p></html>"));
end angularVelocity1;
