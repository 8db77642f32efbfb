within ContactMultiBody.Parts;
model FreeBody "Rigid body that moves freely and can collide; its orientation is integrated without a constraint"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody.Frames;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame, fixed to the body"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  parameter Boolean animation=true "= true, if the body is shown as a sphere" annotation (choices(checkBox=true));
  parameter SI.Mass m(min=Modelica.Constants.small, start=1) "Mass";
  parameter SI.Position r_CM[3](start={0,0,0}) "Centre of mass from the origin of frame_a, in its coordinates";
  parameter SI.Inertia I_11(min=0)=0.001 "Element (1,1) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter SI.Inertia I_22(min=0)=0.001 "Element (2,2) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter SI.Inertia I_33(min=0)=0.001 "Element (3,3) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter SI.Inertia I_21(min=-Modelica.Constants.inf)=0 "Element (2,1) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter SI.Inertia I_31(min=-Modelica.Constants.inf)=0 "Element (3,1) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter SI.Inertia I_32(min=-Modelica.Constants.inf)=0 "Element (3,2) of the inertia tensor" annotation (Dialog(group="Inertia tensor about the centre of mass"));
  parameter String geometry="" "Descriptor of the geometry in frame_a, see Shapes; empty: does not collide"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  parameter Boolean angles_fixed=false "= true, if angles_start are initial values, else guesses"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));
  parameter SI.Angle angles_start[3]={0,0,0} "Angles of the rotation from the world frame to frame_a"
    annotation (Dialog(tab="Initialization"));
  parameter Modelica.Mechanics.MultiBody.Types.RotationSequence sequence_start={1,2,3} "Axes of angles_start"
    annotation (Evaluate=true, Dialog(tab="Initialization"));
  parameter Boolean w_0_fixed=false "= true, if w_0_start are initial values, else guesses"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));
  parameter SI.AngularVelocity w_0_start[3]={0,0,0} "Angular velocity of frame_a, in world axes"
    annotation (Dialog(tab="Initialization"));
  parameter SI.Diameter sphereDiameter=world.defaultBodyDiameter "Diameter of the sphere about the centre of mass"
    annotation (Dialog(tab="Animation", enable=animation));
  input Modelica.Mechanics.MultiBody.Types.Color sphereColor=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour of the sphere"
    annotation (Dialog(colorSelector=true, tab="Animation", enable=animation));
  input Modelica.Mechanics.MultiBody.Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of ambient light"
    annotation (Dialog(tab="Animation", enable=animation));
  final parameter SI.Inertia I[3, 3]={{I_11,I_21,I_31},{I_21,I_22,I_32},{I_31,I_32,I_33}}
    "Inertia tensor about the centre of mass, in coordinates of frame_a";
  parameter Boolean checkInertia=true "= true, if a tensor of inertia that no body has is told of: a principal moment larger than the sum of the others"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Advanced"));
  final parameter Inertia inertia(m=m, r_CM=r_CM, I=I) "Inertia, for contacts without events";
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
  final parameter Frames.Orientation R_start=Frames.axesRotations(sequence_start, angles_start, zeros(3))
    "Orientation of frame_a that angles_start mean";
  final parameter Real Q_start[4](each unit="1")=Frames.to_Q(R_start) "Quaternion that angles_start mean";

  SI.Position r_0[3](start={0,0,0}, each stateSelect=StateSelect.always) "Position of frame_a, in world axes";
  SI.Velocity v_0[3](start={0,0,0}, each stateSelect=StateSelect.always) "Velocity of frame_a, in world axes";
  SI.Acceleration a_0[3] "Acceleration of frame_a, in world axes";
  Real Q[4](start=Q_start, fixed=fill(angles_fixed, 4), each stateSelect=StateSelect.always, each unit="1")
    "Quaternion from the world to frame_a, of length 1 but for errors of integration";
  SI.AngularVelocity w_a[3](
    start=Frames.resolve2(R_start, w_0_start),
    fixed=fill(w_0_fixed, 3),
    each stateSelect=StateSelect.always) "Angular velocity of frame_a, in its axes";
  SI.AngularAcceleration z_a[3] "Angular acceleration of frame_a, in its axes";
  SI.Acceleration g_0[3] "Acceleration of gravity at the centre of mass, in world axes";
protected
  constant SI.Frequency stabilisation=1 "Rate at which the length of the quaternion returns to 1";
  outer Modelica.Mechanics.MultiBody.World world;
  Real s(unit="1") "2 by the square of the quaternion's length";
  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape sphere(
    shapeType="sphere",
    color=sphereColor,
    specularCoefficient=specularCoefficient,
    length=sphereDiameter,
    width=sphereDiameter,
    height=sphereDiameter,
    lengthDirection={1,0,0},
    widthDirection={0,1,0},
    r_shape=r_CM - {sphereDiameter/2,0,0},
    r=frame_a.r_0,
    R=frame_a.R) if world.enableAnimation and animation;
equation
  Connections.root(frame_a.R);
  s = 2/(Q*Q);
  frame_a.R.T = {
    {1 - s*(Q[2]*Q[2] + Q[3]*Q[3]),s*(Q[1]*Q[2] + Q[3]*Q[4]),s*(Q[1]*Q[3] - Q[2]*Q[4])},
    {s*(Q[1]*Q[2] - Q[3]*Q[4]),1 - s*(Q[1]*Q[1] + Q[3]*Q[3]),s*(Q[2]*Q[3] + Q[1]*Q[4])},
    {s*(Q[1]*Q[3] + Q[2]*Q[4]),s*(Q[2]*Q[3] - Q[1]*Q[4]),1 - s*(Q[1]*Q[1] + Q[2]*Q[2])}};
  frame_a.R.w = w_a;
  der(Q) = {
    (Q[4]*w_a[1] - Q[3]*w_a[2] + Q[2]*w_a[3])/2 + stabilisation*(1 - Q*Q)*Q[1],
    (Q[3]*w_a[1] + Q[4]*w_a[2] - Q[1]*w_a[3])/2 + stabilisation*(1 - Q*Q)*Q[2],
    (-Q[2]*w_a[1] + Q[1]*w_a[2] + Q[4]*w_a[3])/2 + stabilisation*(1 - Q*Q)*Q[3],
    -(Q[1]*w_a[1] + Q[2]*w_a[2] + Q[3]*w_a[3])/2 + stabilisation*(1 - Q*Q)*Q[4]};

  r_0 = frame_a.r_0;
  v_0 = der(r_0);
  a_0 = der(v_0);
  z_a = der(w_a);
  g_0 = world.gravityAcceleration(frame_a.r_0 + Frames.resolve1(frame_a.R, r_CM));
  frame_a.f = m*(Frames.resolve2(frame_a.R, a_0 - g_0) + cross(z_a, r_CM) + cross(w_a, cross(w_a, r_CM)));
  frame_a.t = I*z_a + cross(w_a, I*w_a) + cross(r_CM, frame_a.f);
  assert(Internal.isSemidefinite(I), "The tensor of inertia has a negative principal moment.");
  assert(not checkInertia or Internal.isSemidefinite(identity(3)*(I[1, 1] + I[2, 2] + I[3, 3])/2 - I), "No body has this tensor of inertia: a principal moment is larger than the sum of the other two. Right all the same if it turns about one axis alone; else correct it. checkInertia = false ends this warning.",
    AssertionLevel.warning);
  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,20},{0,-20}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Ellipse(extent={{-40,60},{80,-60}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,110},{150,70}}, textString="%name", textColor={0,0,255}),
        Text(extent={{-150,-70},{150,-100}}, textString="m=%m")}),
    Documentation(info="<html>
<p>
Takes the place of <a href=\"modelica://ContactMultiBody.Parts.Body\">Body</a> where a body is not connected to the world by joints, with the same parameters and variables; its animation is a sphere about the centre of mass.
Its 13 states are position, velocity, quaternion and angular velocity, and each has a differential equation of its own. Body has the quaternion's unit length as an algebraic
constraint, so that a tool has to choose three of the four components as states, and others during the simulation: some tools do not do that in FMUs that they export, see
<a href=\"modelica://ContactMultiBody.UsersGuide.ToolNotes\">Tool notes</a>. The motion is the same.
</p>
<p>
The length of the quaternion returns to 1 by a correction along it, which turns nothing (Baumgarte 1972); the rotation matrix is orthonormal whatever that length is.
Joints may be connected to <code>frame_a</code>: the body is then the root of the mechanism, as Body with <code>enforceStates=true</code>.
</p>
</html>"));
end FreeBody;
