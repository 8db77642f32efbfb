within Modelica.Mechanics.MultiBody.Frames;
function resolve2 "Coordinates in frame 2 of a vector given in frame 1"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Real v1[3] "Coordinates in frame 1";
  output Real v2[3] "Coordinates in frame 2";
algorithm
  v2 := R.T*v1;
  annotation (derivative(noDerivative=R) = Internal.resolve2_der, InlineAfterIndexReduction=true, Documentation(info="<html>
<p>Multiplies with the rotation matrix. Its time derivative follows from the angular velocity, see <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Internal.resolve2_der\">resolve2_der</a>.</p></html>"));
end resolve2;
