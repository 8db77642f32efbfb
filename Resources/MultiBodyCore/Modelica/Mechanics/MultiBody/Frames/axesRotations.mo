within Modelica.Mechanics.MultiBody.Frames;
function axesRotations "Three rotations about coordinate axes, one after the other"
  extends Modelica.Icons.Function;
  input Integer sequence[3](min={1,1,1}, max={3,3,3}) = {1,2,3} "Axes: the first of frame 1, each next one of the frame turned so far";
  input SI.Angle angles[3] "Angles about these axes";
  input SI.AngularVelocity der_angles[3] "Derivatives of angles";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
algorithm
  R := absoluteRotation(absoluteRotation(axisRotation(sequence[1], angles[1], der_angles[1]),
    axisRotation(sequence[2], angles[2], der_angles[2])), axisRotation(sequence[3], angles[3], der_angles[3]));
  annotation (Inline=true, Documentation(info="<html>
<p>Cardan angles for the sequence {1,2,3}, Euler angles for {3,1,3}. The composition of three rotations about single axes, each with its angular velocity.</p></html>"));
end axesRotations;
