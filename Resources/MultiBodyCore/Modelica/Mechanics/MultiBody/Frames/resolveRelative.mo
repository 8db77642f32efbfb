within Modelica.Mechanics.MultiBody.Frames;
function resolveRelative "Coordinates in frame 2 of a vector given in frame 1, both oriented absolutely"
  extends Modelica.Icons.Function;
  input Real v1[3] "Coordinates in frame 1";
  input Orientation R1 "Absolute orientation of frame 1";
  input Orientation R2 "Absolute orientation of frame 2";
  output Real v2[3] "Coordinates in frame 2";
algorithm
  v2 := resolve2(R2, resolve1(R1, v1));
  annotation (Inline=true, Documentation(info="<html>
<p>By way of the world frame.</p></html>"));
end resolveRelative;
