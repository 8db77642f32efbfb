within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function orientationConstraint "Residue that is zero when the length is 1"
  extends Modelica.Icons.Function;
  input Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  output Real residue[1] "Square of the length, less 1";
algorithm
  residue := {Q*Q - 1};
  annotation (Inline=true, Documentation(info="<html>
<p>A quaternion means a rotation if its length is 1.</p></html>"));
end orientationConstraint;
