within Modelica.Mechanics.MultiBody.Frames;
function orientationConstraint "Six residues that are zero when T is a rotation matrix"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation";
  output Real residue[6] "Residues of the orthonormality of the columns of T";
algorithm
  residue := {R.T[:, 1]*R.T[:, 1] - 1, R.T[:, 2]*R.T[:, 2] - 1, R.T[:, 3]*R.T[:, 3] - 1, R.T[:, 1]*R.T[:, 2],
      R.T[:, 1]*R.T[:, 3], R.T[:, 2]*R.T[:, 3]};
  annotation (Inline=true, Documentation(info="<html>
<p>The columns of a rotation matrix are orthonormal: three lengths and three scalar products.</p></html>"));
end orientationConstraint;
