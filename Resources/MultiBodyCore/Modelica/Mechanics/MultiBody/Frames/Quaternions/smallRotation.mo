within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function smallRotation "Angles of a small rotation"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  output SI.Angle phi[3] "Angles about x, y and z, if they are small";
algorithm
  phi := 2*Q[1:3];
  annotation (Inline=true, Documentation(info="<html>
<p>For small angles <code>sin(angle/2) = angle/2</code>.</p></html>"));
end smallRotation;
