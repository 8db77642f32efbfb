within Modelica.Mechanics.MultiBody.Parts;
model BodyShape "Rigid body with two frames"
  import Modelica.Mechanics.MultiBody.Types;
  Interfaces.Frame_a frame_a "First frame, fixed to the body"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Interfaces.Frame_b frame_b "Second frame, fixed to the body"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  parameter Boolean animation=true "= true, if shapes are shown";
  parameter Boolean animateSphere=true "= true, if the centre of mass is shown";
  parameter SI.Position r[3](start={0,0,0}) "Position of frame_b from the origin of frame_a, in coordinates of frame_a";
  parameter SI.Position r_CM[3](start={0,0,0}) "Centre of mass from the origin of frame_a, in its coordinates";
  parameter SI.Mass m(min=0, start=1) "Mass";
  parameter SI.Inertia I_11(min=0) = 0.001 "Element (1,1) of the inertia tensor";
  parameter SI.Inertia I_22(min=0) = 0.001 "Element (2,2) of the inertia tensor";
  parameter SI.Inertia I_33(min=0) = 0.001 "Element (3,3) of the inertia tensor";
  parameter SI.Inertia I_21(min=-Modelica.Constants.inf) = 0 "Element (2,1) of the inertia tensor";
  parameter SI.Inertia I_31(min=-Modelica.Constants.inf) = 0 "Element (3,1) of the inertia tensor";
  parameter SI.Inertia I_32(min=-Modelica.Constants.inf) = 0 "Element (3,2) of the inertia tensor";
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
  parameter Types.ShapeType shapeType="cylinder" "Kind of shape" annotation (Dialog(tab="Animation"));
  parameter SI.Position r_shape[3]={0,0,0} "Position of the shape from the origin of frame_a, in its coordinates" annotation (Dialog(tab="Animation"));
  parameter Types.Axis lengthDirection=Modelica.Units.Conversions.to_unit1(r - r_shape) "Direction of the length" annotation (Dialog(tab="Animation"));
  parameter Types.Axis widthDirection={0,1,0} "Direction of the width" annotation (Dialog(tab="Animation"));
  parameter SI.Length length=Modelica.Math.Vectors.length(r - r_shape) "Length" annotation (Dialog(tab="Animation"));
  parameter SI.Distance width=length/world.defaultWidthFraction "Width" annotation (Dialog(tab="Animation"));
  parameter SI.Distance height=width "Height" annotation (Dialog(tab="Animation"));
  parameter Types.ShapeExtra extra=0.0 "One more number that some shapes need" annotation (Dialog(tab="Animation"));
  input Types.Color color=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter SI.Diameter sphereDiameter=2*width "Diameter of the sphere" annotation (Dialog(tab="Animation"));
  input Types.Color sphereColor=color "Colour of the sphere" annotation (Dialog(tab="Animation"));
  parameter Boolean enforceStates=false "= true, if the body's coordinates shall be states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean useQuaternions=true "= true, if a free body's orientation states are quaternions, else angles"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Types.RotationSequence sequence_angleStates={1,2,3} "Axes of the angles, if these are states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  FixedTranslation frameTranslation(r=r, animation=false) "From frame_a to frame_b";
  Body body(
    r_CM=r_CM,
    m=m,
    I_11=I_11,
    I_22=I_22,
    I_33=I_33,
    I_21=I_21,
    I_31=I_31,
    I_32=I_32,
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
        Rectangle(extent={{-100,8},{100,-8}}, lineColor={70,70,70}, fillColor={155,155,155}, fillPattern=FillPattern.HorizontalCylinder),
        Ellipse(extent={{-50,50},{50,-50}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A <a href=\"modelica://Modelica.Mechanics.MultiBody.Parts.Body\">Body</a> at frame_a and a second frame displaced by
<code>r</code>.</p></html>"));
end BodyShape;
