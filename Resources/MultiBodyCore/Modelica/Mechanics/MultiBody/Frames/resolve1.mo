within Modelica.Mechanics.MultiBody.Frames;
function resolve1 "Coordinates in frame 1 of a vector given in frame 2"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Real v2[3] "Coordinates in frame 2";
  output Real v1[3] "Coordinates in frame 1";
algorithm
  v1 := transpose(R.T)*v2;
  annotation (derivative(noDerivative=R) = Internal.resolve1_der, InlineAfterIndexReduction=true, Documentation(info="<html>
<p>Multiplies with the transpose of the rotation matrix. Its time derivative follows from the angular velocity, see <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Internal.resolve1_der\">resolve1_der</a>.</p></html>"));
end resolve1;
