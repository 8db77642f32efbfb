within Modelica.Mechanics.MultiBody.Frames;
function from_T2 "Orientation from a rotation matrix and its derivative"
  extends Modelica.Icons.Function;
  input Real T[3, 3] "Rotation matrix, coordinates in frame 1 to coordinates in frame 2";
  input Real der_T[3, 3] "Derivative of T";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := Orientation(T=T, w={T[3, :]*der_T[2, :], T[1, :]*der_T[3, :], T[2, :]*der_T[1, :]});
  annotation (Inline=true, Documentation(info="<html>
<p>From <code>der(T) = -skew(w)*T</code>, that is <code>skew(w) = -der(T)*transpose(T)</code>.</p></html>"));
end from_T2;
