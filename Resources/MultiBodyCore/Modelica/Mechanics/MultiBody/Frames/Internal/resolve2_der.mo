within Modelica.Mechanics.MultiBody.Frames.Internal;
function resolve2_der "Time derivative of resolve2"
  extends Modelica.Icons.Function;
  import Modelica.Mechanics.MultiBody.Frames;
  input Frames.Orientation R "Orientation of frame 2 with respect to frame 1";
  input Real v1[3] "Coordinates in frame 1";
  input Real v1_der[3] "Derivatives of v1";
  output Real v2_der[3] "Derivatives of the coordinates in frame 2";
algorithm
  v2_der := Frames.resolve2(R, v1_der) - cross(R.w, Frames.resolve2(R, v1));
  annotation (InlineAfterIndexReduction=true, Documentation(info="<html>
<p>The vector changes by what it changes in frame 1, less the turning of frame 2. The derivative of the rotation matrix is not needed.</p></html>"));
end resolve2_der;
