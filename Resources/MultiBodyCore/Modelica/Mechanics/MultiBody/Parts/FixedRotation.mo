within Modelica.Mechanics.MultiBody.Parts;
model FixedRotation "Two frames at a fixed distance and with a fixed rotation"
  import Modelica.Mechanics.MultiBody.Types;
  import Modelica.Mechanics.MultiBody.Frames;
  Interfaces.Frame_a frame_a "First frame, fixed to the rod"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame, fixed to the rod"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if a shape is shown";
  parameter SI.Position r[3]={0,0,0} "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  parameter Types.RotationTypes rotationType=Modelica.Mechanics.MultiBody.Types.RotationTypes.RotationAxis "Way to say the rotation from frame_a to frame_b";
  parameter Types.Axis n={1,0,0} "Axis of the rotation, for RotationAxis";
  parameter Modelica.Units.NonSI.Angle_deg angle=0 "Angle of the rotation about n, for RotationAxis";
  parameter Types.Axis n_x={1,0,0} "x-axis of frame_b in coordinates of frame_a, for TwoAxesVectors";
  parameter Types.Axis n_y={0,1,0} "Vector in the xy-plane of frame_b in coordinates of frame_a, for TwoAxesVectors";
  parameter Types.RotationSequence sequence(min={1,1,1}, max={3,3,3}) = {1,2,3} "Axes of angles, for PlanarRotationSequence";
  parameter Modelica.Units.NonSI.Angle_deg angles[3]={0,0,0} "Angles of the rotations about the axes of sequence, for PlanarRotationSequence";
  parameter Types.ShapeType shapeType="cylinder" "Kind of shape" annotation (Dialog(tab="Animation"));
  parameter SI.Position r_shape[3]={0,0,0} "Position of the shape from the origin of frame_a, in its coordinates" annotation (Dialog(tab="Animation"));
  parameter Types.Axis lengthDirection=Modelica.Units.Conversions.to_unit1(r - r_shape) "Direction of the length" annotation (Dialog(tab="Animation"));
  parameter Types.Axis widthDirection={0,1,0} "Direction of the width" annotation (Dialog(tab="Animation"));
  parameter SI.Length length=Modelica.Math.Vectors.length(r - r_shape) "Length" annotation (Dialog(tab="Animation"));
  parameter SI.Distance width=length/world.defaultWidthFraction "Width" annotation (Dialog(tab="Animation"));
  parameter SI.Distance height=width "Height" annotation (Dialog(tab="Animation"));
  parameter Types.ShapeExtra extra=0.0 "One more number that some shapes need" annotation (Dialog(tab="Animation"));
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.RodColor "Colour" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  final parameter Frames.Orientation R_rel=if rotationType == Types.RotationTypes.RotationAxis then Frames.planarRotation(
      Modelica.Math.Vectors.normalizeWithAssert(n), Modelica.Units.Conversions.from_deg(angle), 0) else if rotationType == Types.RotationTypes.TwoAxesVectors
       then Frames.from_nxy(n_x, n_y) else Frames.axesRotations(sequence, Modelica.Units.Conversions.from_deg(angles), zeros(3))
    "Orientation of frame_b with respect to frame_a";
protected
  outer Modelica.Mechanics.MultiBody.World world;
  parameter Frames.Orientation R_rel_inv=Frames.from_T(transpose(R_rel.T), zeros(3)) "Orientation of frame_a with respect to frame_b";
equation
  Connections.branch(frame_a.R, frame_b.R);
  frame_b.r_0 = frame_a.r_0 + Frames.resolve1(frame_a.R, r);
  if Connections.rooted(frame_a.R) then
    frame_b.R = Frames.absoluteRotation(frame_a.R, R_rel);
    frame_a.f = -Frames.resolve1(R_rel, frame_b.f);
    frame_a.t = -Frames.resolve1(R_rel, frame_b.t) + cross(r, frame_a.f);
  else
    frame_a.R = Frames.absoluteRotation(frame_b.R, R_rel_inv);
    frame_b.f = -Frames.resolve2(R_rel, frame_a.f);
    frame_b.t = -Frames.resolve2(R_rel, frame_a.t - cross(r, frame_a.f));
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{10,0},{90,50}}, color={70,70,70}, thickness=2),
        Line(points={{10,0},{84,0}}, color={70,70,70}, pattern=LinePattern.Dash),
        Text(extent={{-150,-40},{150,-75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A bent rod without mass: frame_b is displaced by <code>r</code> and turned. The rotation is given by an axis and an
angle, by two vectors of frame_b, or by three angles about coordinate axes.</p></html>"));
end FixedRotation;
