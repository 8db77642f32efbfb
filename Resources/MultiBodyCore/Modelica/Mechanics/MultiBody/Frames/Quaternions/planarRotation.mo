within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function planarRotation "Quaternion of a rotation about a fixed axis"
  extends Modelica.Icons.Function;
  input Real e[3](each final unit="1") "Axis, of length 1";
  input SI.Angle angle "Angle of the rotation, right-handed about e";
  output Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
algorithm
  Q := cat(1, sin(angle/2)*e, {cos(angle/2)});
  annotation (Inline=true, Documentation(info="<html>
<p>The definition of the quaternion.</p></html>"));
end planarRotation;
