within Modelica.Mechanics.MultiBody.Frames.Internal;
function resolve1_der "Time derivative of resolve1"
  extends Modelica.Icons.Function;
  import Modelica.Mechanics.MultiBody.Frames;
  input Frames.Orientation R "Orientation of frame 2 with respect to frame 1";
  input Real v2[3] "Coordinates in frame 2";
  input Real v2_der[3] "Derivatives of v2";
  output Real v1_der[3] "Derivatives of the coordinates in frame 1";
algorithm
  v1_der := Frames.resolve1(R, v2_der + cross(R.w, v2));
  annotation (InlineAfterIndexReduction=true, Documentation(info="<html>
<p>The vector changes by what it changes in frame 2 and by the turning of frame 2. The derivative of the rotation matrix is not needed.</p></html>"));
end resolve1_der;
