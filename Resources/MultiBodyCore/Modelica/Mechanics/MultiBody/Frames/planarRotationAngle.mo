within Modelica.Mechanics.MultiBody.Frames;
function planarRotationAngle "Angle of the rotation about an axis that takes one vector to another"
  extends Modelica.Icons.Function;
  input Real e[3](each final unit="1") "Axis, of length 1";
  input Real v1[3] "Coordinates of a vector in frame 1, not parallel to e";
  input Real v2[3] "Coordinates of the same vector in frame 2";
  output SI.Angle angle "Angle between -pi and pi";
algorithm
  angle := atan2(-(e*cross(v1, v2)), v1*v2 - (e*v1)*(e*v2));
  annotation (Inline=true, Documentation(info="<html>
<p>Inverse of planarRotation: the angle for which <code>v2 = resolve2(planarRotation(e, angle, 0), v1)</code>. Sine and cosine of the angle, both times the square of the part of the vector across the axis, give it in all four quadrants.</p></html>"));
end planarRotationAngle;
