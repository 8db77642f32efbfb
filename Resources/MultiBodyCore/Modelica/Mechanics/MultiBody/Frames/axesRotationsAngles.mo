within Modelica.Mechanics.MultiBody.Frames;
function axesRotationsAngles "Angles of three rotations about coordinate axes that give an orientation"
  extends Modelica.Icons.Function;
  import Modelica.Mechanics.MultiBody.Frames;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Integer sequence[3](min={1,1,1}, max={3,3,3}) = {1,2,3} "Axes: the first of frame 1, each next one of the frame turned so far";
  input SI.Angle guessAngle1=0 "Of the two solutions the one whose first angle is nearer to this one is taken";
  output SI.Angle angles[3] "Angles, with -pi < angles[i] <= pi";
protected
  Real e1[3] = Frames.axis(sequence[1]) "First axis";
  Real e2[3] = Frames.axis(sequence[2]) "Second axis, after the first rotation";
  Real e3[3] = Frames.axis(sequence[3]) "Third axis, after the second rotation";
  Real a3[3] = transpose(R.T)*e3 "Third axis in coordinates of frame 1";
  Real s "Component of the third axis along the second one before it is turned";
  Real c "Component of the third axis across the first two";
  Orientation R1 "The first rotation alone";
algorithm
  assert(sequence[1] <> sequence[2] and sequence[2] <> sequence[3], "Two rotations in succession about the same axis are one: give a sequence whose neighbours differ");
  s := e2*a3;
  c := cross(e1, e2)*a3;
  angles[1] := if abs(s) < 1e-12 and abs(c) < 1e-12 then guessAngle1 else if c*cos(guessAngle1) - s*sin(guessAngle1) >= 0 then atan2(-s, c) else atan2(s, -c);
  R1 := axisRotation(sequence[1], angles[1], 0);
  angles[2] := planarRotationAngle(e2, R1.T*a3, e3);
  angles[3] := planarRotationAngle(e3, e2, R.T*(transpose(R1.T)*e2));
  annotation (Documentation(info="<html>
<p>The second axis stands on the third one for every angle of the second rotation. After the first rotation the second axis is <code>cos(angles[1])*e2 + sin(angles[1])*cross(e1, e2)</code>; that its product with the third axis is zero gives the first angle up to half a turn. The other two follow from what they turn. If first and third axis are parallel, the first angle is arbitrary: <code>guessAngle1</code> is taken.</p></html>"));
end axesRotationsAngles;
