within Modelica.Mechanics.MultiBody.Parts;
model Body "Rigid body with one frame"
  import Modelica.Mechanics.MultiBody.Types;
  import Modelica.Mechanics.MultiBody.Frames;
  Interfaces.Frame_a frame_a "Frame, fixed to the body"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  parameter Boolean animation=true "= true, if shapes are shown";
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
  parameter SI.Diameter sphereDiameter=world.defaultBodyDiameter "Diameter of the sphere" annotation (Dialog(tab="Animation"));
  input Types.Color sphereColor=Modelica.Mechanics.MultiBody.Types.Defaults.BodyColor "Colour of the sphere" annotation (Dialog(tab="Animation"));
  parameter SI.Diameter cylinderDiameter=sphereDiameter/Types.Defaults.BodyCylinderDiameterFraction "Diameter of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.Color cylinderColor=sphereColor "Colour of the cylinder" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter Boolean enforceStates=false "= true, if the body's coordinates shall be states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean useQuaternions=true "= true, if a free body's orientation states are quaternions, else angles"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Types.RotationSequence sequence_angleStates={1,2,3} "Axes of the angles, if these are states"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  final parameter SI.Inertia I[3, 3]=[I_11, I_21, I_31; I_21, I_22, I_32; I_31, I_32, I_33]
    "Inertia tensor about the centre of mass, in coordinates of frame_a";
  final parameter Frames.Orientation R_start=Frames.axesRotations(sequence_start, angles_start, zeros(3))
    "Orientation of frame_a that angles_start mean";
  SI.AngularVelocity w_a[3](
    start=Frames.resolve2(R_start, w_0_start),
    fixed=fill(w_0_fixed, 3),
    each stateSelect=if not enforceStates then StateSelect.avoid else if useQuaternions then StateSelect.always else StateSelect.never)
    "Angular velocity of frame_a, in its coordinates";
  SI.AngularAcceleration z_a[3](start=Frames.resolve2(R_start, z_0_start), fixed=fill(z_0_fixed, 3))
    "Angular acceleration of frame_a, in its coordinates";
  SI.Acceleration g_0[3] "Acceleration by gravity, in coordinates of the world frame";
protected
  outer Modelica.Mechanics.MultiBody.World world;
  parameter Frames.Quaternions.Orientation Q_start=Frames.to_Q(R_start) "Quaternion that angles_start mean";
  Frames.Quaternions.Orientation Q(start=Q_start, each stateSelect=if not enforceStates then StateSelect.avoid else if useQuaternions
         then StateSelect.prefer else StateSelect.never) "Quaternion of frame_a, if it is the state";
  parameter SI.Angle phi_start[3]=if sequence_start[1] == sequence_angleStates[1] and sequence_start[2] == sequence_angleStates[2] and
      sequence_start[3] == sequence_angleStates[3] then angles_start else Frames.axesRotationsAngles(R_start, sequence_angleStates)
    "Angles about the axes of sequence_angleStates that angles_start mean";
  SI.Angle phi[3](start=phi_start, each stateSelect=if useQuaternions then (if enforceStates then StateSelect.never else StateSelect.avoid)
         else if enforceStates then StateSelect.always else StateSelect.default) "Angles of frame_a, if they are the states";
  SI.AngularVelocity phi_d[3](each stateSelect=if useQuaternions then (if enforceStates then StateSelect.never else StateSelect.avoid)
         else if enforceStates then StateSelect.always else StateSelect.default) "Derivatives of phi";
  SI.AngularAcceleration phi_dd[3] "Second derivatives of phi";
initial equation
  if angles_fixed then
    if not Connections.isRoot(frame_a.R) then
      zeros(3) = Frames.Orientation.equalityConstraint(frame_a.R, R_start);
    elseif useQuaternions then
      Q = Q_start;
    else
      phi = phi_start;
    end if;
  elseif Connections.isRoot(frame_a.R) and useQuaternions then
    // What holds the body decides on three of four components.
    Q*Q = 1;
  end if;
equation
  if enforceStates then
    Connections.root(frame_a.R);
  else
    Connections.potentialRoot(frame_a.R);
  end if;

  // A body that starts a tree of frames says its own orientation by states; all others get it through their frame.
  if not Connections.isRoot(frame_a.R) then
    Q = {0, 0, 0, 1};
    phi = zeros(3);
    phi_d = zeros(3);
    phi_dd = zeros(3);
    w_a = Frames.angularVelocity2(frame_a.R);
  elseif useQuaternions then
    der(Q) = Frames.Internal.quaternionRate(Q, w_a);
    frame_a.R = Frames.from_Q(Q, w_a);
    phi = zeros(3);
    phi_d = zeros(3);
    phi_dd = zeros(3);
  else
    phi_d = der(phi);
    phi_dd = der(phi_d);
    frame_a.R = Frames.axesRotations(sequence_angleStates, phi, phi_d);
    Q = {0, 0, 0, 1};
    w_a = Frames.angularVelocity2(frame_a.R);
  end if;

  r_0 = frame_a.r_0;
  v_0 = der(r_0);
  a_0 = der(v_0);
  z_a = der(w_a);
  g_0 = world.gravityAcceleration(r_0 + Frames.resolve1(frame_a.R, r_CM));

  // Newton for the centre of mass, Euler about it, the cut torque then taken to the origin of frame_a
  frame_a.f = m*(Frames.resolve2(frame_a.R, a_0 - g_0) + cross(z_a, r_CM) + cross(w_a, cross(w_a, r_CM)));
  frame_a.t = I*z_a + cross(w_a, I*w_a) + cross(r_CM, frame_a.f);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,20},{0,-20}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.HorizontalCylinder),
        Ellipse(extent={{-30,60},{90,-60}}, lineColor={0,60,140}, fillColor={0,110,220}, fillPattern=FillPattern.Sphere),
        Text(extent={{-150,100},{150,65}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>A rigid body of mass <code>m</code> whose centre of mass lies at <code>r_CM</code> from frame_a and whose inertia tensor
about the centre of mass, in the directions of frame_a, is <code>I</code>. Newton's and Euler's equations are written at frame_a.</p>
<p>A body that is not fixed to the world through joints starts a tree of its own. Then its orientation is a state: a quaternion
(<code>useQuaternions = true</code>), nowhere singular, or three angles about the axes of <code>sequence_angleStates</code>, which
are singular where the second one makes the other two axes parallel.
The quaternion's four components are integrated as ordinary states, see
<a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Internal.quaternionRate\">quaternionRate</a>.</p>
<p>Initial values: <code>r_0(start, fixed)</code>, <code>v_0(start, fixed)</code>, and for the rotation
<code>angles_start</code>, <code>w_0_start</code>, <code>z_0_start</code> with their <code>_fixed</code>.</p></html>"));
end Body;
