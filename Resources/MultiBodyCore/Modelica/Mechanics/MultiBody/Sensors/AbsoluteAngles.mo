within Modelica.Mechanics.MultiBody.Sensors;
model AbsoluteAngles "Angles of a frame"
  extends Internal.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput angles[3](each final quantity="Angle", each final unit="rad", each displayUnit="deg")
    "Angles of the rotation from the world frame to frame_a" annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  parameter Modelica.Mechanics.MultiBody.Types.RotationSequence sequence(min={1,1,1}, max={3,3,3}) = {1,2,3} "Axes of the angles";
  parameter SI.Angle guessAngle1=0 "Of the two solutions the one whose first angle is nearer to this one is taken";
equation
  angles = Frames.axesRotationsAngles(frame_a.R, sequence, guessAngle1);
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  annotation (Documentation(info="<html>
<p>Angles of three rotations about coordinate axes that turn the world frame into frame_a, see
<a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.axesRotationsAngles\">axesRotationsAngles</a>.</p></html>"));
end AbsoluteAngles;
