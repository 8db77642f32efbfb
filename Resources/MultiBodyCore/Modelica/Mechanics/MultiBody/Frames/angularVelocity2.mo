within Modelica.Mechanics.MultiBody.Frames;
function angularVelocity2 "Angular velocity in coordinates of frame 2"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  output SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 2";
algorithm
  w := R.w;
  annotation (Inline=true, Documentation(info="<html>
<p>Angular velocity of frame 2 with respect to frame 1, resolved in frame 2.</p></html>"));
end angularVelocity2;
