within Modelica.Mechanics.MultiBody.Frames;
function smallRotation "Angles of a small rotation"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Boolean withResidues=false "= true, if the residues of the orthonormality of T follow the angles";
  output SI.Angle phi[if withResidues then 6 else 3] "Angles about x, y and z, if they are small";
protected
  Real s[3] = {R.T[2, 3] - R.T[3, 2], R.T[3, 1] - R.T[1, 3], R.T[1, 2] - R.T[2, 1]}/2 "Axis times sine of the angle";
algorithm
  phi := if withResidues then cat(1, s, {R.T[1, :]*R.T[1, :] - 1, R.T[2, :]*R.T[2, :] - 1, R.T[1, :]*R.T[2, :]}) else s;
  annotation (Documentation(info="<html>
<p>For small angles <code>T = identity(3) - skew(phi)</code>.</p></html>"));
end smallRotation;
