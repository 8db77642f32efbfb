within Modelica.Mechanics.MultiBody.Parts;
model BodyCylinder "Rigid cylinder; mass and inertia follow from size and density"
  import Modelica.Mechanics.MultiBody.Types;
  import Modelica.Mechanics.MultiBody.Frames;
  import Modelica.Constants.pi;
  Interfaces.Frame_a frame_a "First frame, fixed to the cylinder"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame, fixed to the cylinder"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if the cylinder is shown";
  parameter SI.Position r[3](start={0.1,0,0}) "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  parameter SI.Position r_shape[3]={0,0,0} "Middle of the left face from the origin of frame_a, in its coordinates";
  parameter Types.Axis lengthDirection=Modelica.Units.Conversions.to_unit1(r - r_shape) "Direction of the length";
  parameter SI.Length length=Modelica.Math.Vectors.length(r - r_shape) "Length";
  parameter SI.Distance diameter=length/world.defaultWidthFraction "Diameter";
  parameter SI.Distance innerDiameter=0 "Diameter of the bore";
  parameter SI.Density density=7700 "Density";
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  SI.Position r_0[3](start={0,0,0}, each stateSelect=if enforceStates then StateSelect.always else StateSelect.avoid)
    "Position of frame_a, from the origin of the world frame, in its coordinates";
  SI.Velocity v_0[3](start={0,0,0}, each stateSelect=if enforceStates then StateSelect.always else StateSelect.avoid)
    "Velocity of frame_a, in coordinates of the world frame";
  SI.Acceleration a_0[3](start={0,0,0}) "Acceleration of frame_a, in coordinates of the world frame";
  parameter Boolean angles_fixed=false "= true, if angles_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.Angle angles_start[3]={0,0,0} "Angles of the rotation from the world frame to frame_a"
    annotation (Dialog(tab="Initialization"));
  parameter Types.RotationSequence sequence_start={1,2,3} "Axes of angles_start"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean w_0_fixed=false "= true, if w_0_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.AngularVelocity w_0_start[3]={0,0,0} "Angular velocity of frame_a, in coordinates of the world frame"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean z_0_fixed=false "= true, if z_0_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.AngularAcceleration z_0_start[3]={0,0,0} "Angular acceleration of frame_a, in coordinates of the world frame"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean enforceStates=false "= true, if the body's coordinates shall be states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean useQuaternions=true "= true, if a free body's orientation states are quaternions, else angles"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Types.RotationSequence sequence_angleStates={1,2,3} "Axes of the angles, if these are states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  final parameter SI.Distance radius=diameter/2 "Radius";
  final parameter SI.Distance innerRadius=innerDiameter/2 "Radius of the bore";
  final parameter SI.Mass mo(min=0) = density*pi*radius^2*length "Mass without the bore";
  final parameter SI.Mass mi(min=0) = density*pi*innerRadius^2*length "Mass missing in the bore";
  final parameter SI.Inertia I22=(mo*(length^2 + 3*radius^2) - mi*(length^2 + 3*innerRadius^2))/12 "Inertia across the axis";
  final parameter SI.Mass m(min=0) = mo - mi "Mass";
  final parameter Frames.Orientation R=Frames.from_nxy(r, {0,1,0}) "Orientation of the principal axes with respect to frame_a";
  final parameter SI.Position r_CM[3]=r_shape + (length/2)*Modelica.Math.Vectors.normalizeWithAssert(lengthDirection)
    "Centre of mass from the origin of frame_a, in its coordinates";
  final parameter SI.Inertia I[3, 3]=Frames.resolveDyade1(R, diagonal({(mo*radius^2 - mi*innerRadius^2)/2, I22, I22}))
    "Inertia tensor about the centre of mass, in coordinates of frame_a";
  Body body(
    r_CM=r_CM,
    m=m,
    I_11=I[1, 1],
    I_22=I[2, 2],
    I_33=I[3, 3],
    I_21=I[2, 1],
    I_31=I[3, 1],
    I_32=I[3, 2],
    animation=false,
    sequence_start=sequence_start,
    angles_fixed=angles_fixed,
    angles_start=angles_start,
    w_0_fixed=w_0_fixed,
    w_0_start=w_0_start,
    z_0_fixed=z_0_fixed,
    z_0_start=z_0_start,
    useQuaternions=useQuaternions,
    sequence_angleStates=sequence_angleStates,
    enforceStates=false) "Mass and inertia";
  FixedTranslation frameTranslation(r=r, animation=false) "From frame_a to frame_b";
protected
  outer Modelica.Mechanics.MultiBody.World world;
equation
  r_0 = frame_a.r_0;
  v_0 = der(r_0);
  a_0 = der(v_0);
  connect(frame_a, frameTranslation.frame_a);
  connect(frame_b, frameTranslation.frame_b);
  connect(frame_a, body.frame_a);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-90,40},{90,-40}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A homogeneous cylinder about the line from frame_a to frame_b, solid or with a bore. Mass, centre of mass and inertia
tensor follow from its dimensions and its density.</p></html>"));
end BodyCylinder;
