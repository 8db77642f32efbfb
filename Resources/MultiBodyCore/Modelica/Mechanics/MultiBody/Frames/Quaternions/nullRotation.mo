within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function nullRotation "Quaternion of no rotation"
  extends Modelica.Icons.Function;
  output Quaternions.Orientation Q "Frame 2 parallel to frame 1";
algorithm
  Q := {0, 0, 0, 1};
  annotation (Inline=true, Documentation(info="<html>
<p>No rotation.</p></html>"));
end nullRotation;
