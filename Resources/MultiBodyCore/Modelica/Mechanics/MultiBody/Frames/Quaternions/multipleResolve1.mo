within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function multipleResolve1 "Coordinates in frame 1 of several vectors given in frame 2"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input Real v2[3, :] "Coordinates in frame 2, a vector a column";
  output Real v1[3, size(v2, 2)] "Coordinates in frame 1";
algorithm
  v1 := transpose(to_T(Q))*v2;
  annotation (Inline=true, Documentation(info="<html>
<p>All columns at once.</p></html>"));
end multipleResolve1;
