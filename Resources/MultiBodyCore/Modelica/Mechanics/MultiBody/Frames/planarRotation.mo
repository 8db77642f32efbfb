within Modelica.Mechanics.MultiBody.Frames;
function planarRotation "Rotation about a fixed axis"
  extends Modelica.Icons.Function;
  input Real e[3](each final unit="1") "Axis, of length 1; its coordinates are the same in both frames";
  input SI.Angle angle "Angle of the rotation, right-handed about e";
  input SI.AngularVelocity der_angle "Derivative of angle";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := Orientation(T=(1 - cos(angle))*outerProduct(e, e) + cos(angle)*identity(3) - sin(angle)*skew(e), w=der_angle*e);
  annotation (Inline=true, Documentation(info="<html>
<p>Euler's and Rodrigues' formula. Turning the frame by an angle turns coordinates by its opposite, hence the minus sign.</p></html>"));
end planarRotation;
