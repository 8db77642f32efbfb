within Modelica.Mechanics.MultiBody.Frames;
function axisRotation "Rotation about a coordinate axis"
  extends Modelica.Icons.Function;
  import Modelica.Mechanics.MultiBody.Frames;
  input Integer axis(min=1, max=3) "Rotate about axis 1, 2 or 3";
  input SI.Angle angle "Angle of the rotation, right-handed about the axis";
  input SI.AngularVelocity der_angle "Derivative of angle";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := planarRotation(Frames.axis(axis), angle, der_angle);
  annotation (Inline=true, Documentation(info="<html>
<p>A rotation about axis x, y or z.</p></html>"));
end axisRotation;
