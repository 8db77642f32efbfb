within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function multipleResolve2 "Coordinates in frame 2 of several vectors given in frame 1"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input Real v1[3, :] "Coordinates in frame 1, a vector a column";
  output Real v2[3, size(v1, 2)] "Coordinates in frame 2";
algorithm
  v2 := to_T(Q)*v1;
  annotation (Inline=true, Documentation(info="<html>
<p>All columns at once.</p></html>"));
end multipleResolve2;
