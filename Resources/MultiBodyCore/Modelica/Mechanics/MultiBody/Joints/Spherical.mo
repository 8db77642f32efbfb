within Modelica.Mechanics.MultiBody.Joints;
model Spherical "Joint that turns about a point"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  import Modelica.Mechanics.MultiBody.Frames;
  import Modelica.Mechanics.MultiBody.Types;
  parameter Boolean animation=true "= true, if a sphere is shown";
  parameter SI.Distance sphereDiameter=world.defaultJointLength "Diameter of the sphere" annotation (Dialog(tab="Animation"));
  input Types.Color sphereColor=Modelica.Mechanics.MultiBody.Types.Defaults.JointColor "Colour of the sphere" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  parameter Boolean angles_fixed=false "= true, if angles_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.Angle angles_start[3]={0,0,0} "Angles of the rotation from frame_a to frame_b"
    annotation (Dialog(tab="Initialization"));
  parameter Types.RotationSequence sequence_start={1,2,3} "Axes of angles_start"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean w_rel_a_fixed=false "= true, if w_rel_a_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.AngularVelocity w_rel_a_start[3]={0,0,0} "Angular velocity of frame_b with respect to frame_a, in coordinates of frame_a"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean z_rel_a_fixed=false "= true, if z_rel_a_start are initial values, else guesses"
    annotation (Dialog(tab="Initialization"));
  parameter SI.AngularAcceleration z_rel_a_start[3]={0,0,0} "Derivative of the angular velocity, in coordinates of frame_a"
    annotation (Dialog(tab="Initialization"));
  parameter Boolean enforceStates=false "= true, if the joint's coordinates shall be states" annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Boolean useQuaternions=true "= true, if the states of the orientation are quaternions, else angles" annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Types.RotationSequence sequence_angleStates={1,2,3} "Axes of the angles, if these are states" annotation (Evaluate=true, Dialog(tab="Advanced"));
  final parameter Frames.Orientation R_rel_start=Frames.axesRotations(sequence_start, angles_start, zeros(3))
    "Orientation of frame_b with respect to frame_a that angles_start mean";
protected
  parameter Frames.Quaternions.Orientation Q_start=Frames.to_Q(R_rel_start) "Quaternion that angles_start mean";
  Frames.Quaternions.Orientation Q(start=Q_start, each stateSelect=if enforceStates and useQuaternions then StateSelect.prefer else StateSelect.never)
    "Quaternion of the rotation from frame_a to frame_b, if it is the state";
  parameter SI.Angle phi_start[3]=if sequence_start[1] == sequence_angleStates[1] and sequence_start[2] == sequence_angleStates[2] and
      sequence_start[3] == sequence_angleStates[3] then angles_start else Frames.axesRotationsAngles(R_rel_start, sequence_angleStates)
    "Angles about the axes of sequence_angleStates that angles_start mean";
  SI.Angle phi[3](start=phi_start, each stateSelect=if enforceStates and not useQuaternions then StateSelect.always else StateSelect.never)
    "Angles of the rotation from frame_a to frame_b, if they are the states";
  SI.AngularVelocity phi_d[3](each stateSelect=if enforceStates and not useQuaternions then StateSelect.always else StateSelect.never)
    "Derivatives of phi";
  SI.AngularAcceleration phi_dd[3] "Second derivatives of phi";
  SI.AngularVelocity w_rel[3](start=Frames.resolve2(R_rel_start, w_rel_a_start), fixed=fill(w_rel_a_fixed, 3),
    each stateSelect=if enforceStates and useQuaternions then StateSelect.always else StateSelect.never)
    "Angular velocity of frame_b with respect to frame_a, in coordinates of frame_b";
  Frames.Orientation R_rel "Orientation of frame_b with respect to frame_a";
initial equation
  if angles_fixed then
    if not enforceStates then
      zeros(3) = Frames.Orientation.equalityConstraint(Frames.absoluteRotation(frame_a.R, R_rel_start), frame_b.R);
    elseif useQuaternions then
      Q = Q_start;
    else
      phi = phi_start;
    end if;
  elseif enforceStates and useQuaternions then
    Q*Q = 1;
  end if;
  if z_rel_a_fixed then
    der(w_rel) = Frames.resolve2(R_rel_start, z_rel_a_start);
  end if;
equation
  frame_b.r_0 = frame_a.r_0;
  zeros(3) = frame_a.t;
  zeros(3) = frame_b.t;
  zeros(3) = frame_a.f + Frames.resolveRelative(frame_b.f, frame_b.R, frame_a.R);

  // Without states of its own the joint says nothing about the orientations: both ends get theirs from elsewhere.
  if not enforceStates then
    R_rel = Frames.relativeRotation(frame_a.R, frame_b.R);
    w_rel = if w_rel_a_fixed or z_rel_a_fixed then Frames.angularVelocity2(R_rel) else zeros(3);
    Q = {0, 0, 0, 1};
    phi = zeros(3);
    phi_d = zeros(3);
    phi_dd = zeros(3);
  else
    Connections.branch(frame_a.R, frame_b.R);
    if Connections.rooted(frame_a.R) then
      frame_b.R = Frames.absoluteRotation(frame_a.R, R_rel);
    else
      frame_a.R = Frames.absoluteRotation(frame_b.R, Frames.inverseRotation(R_rel));
    end if;
    if useQuaternions then
      der(Q) = Frames.Internal.quaternionRate(Q, w_rel);
      R_rel = Frames.from_Q(Q, w_rel);
      phi = zeros(3);
      phi_d = zeros(3);
      phi_dd = zeros(3);
    else
      phi_d = der(phi);
      phi_dd = der(phi_d);
      R_rel = Frames.axesRotations(sequence_angleStates, phi, phi_d);
      w_rel = Frames.angularVelocity2(R_rel);
      Q = {0, 0, 0, 1};
    end if;
  end if;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,70},{70,-70}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{30,70},{71,-70}}, lineColor={255,255,255}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40,40},{40,-40}}, lineColor={70,70,70}, fillColor={150,150,150}, fillPattern=FillPattern.Sphere),
        Line(points={{40,0},{100,0}}, color={70,70,70}, thickness=2),
        Line(points={{-100,0},{-70,0}}, color={70,70,70}, thickness=2),
        Text(extent={{-150,120},{150,85}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The origins of frame_a and frame_b coincide; no torque passes. The joint has no states unless
<code>enforceStates = true</code>; then a quaternion or three angles are states, which keeps the joint from being the place
where a kinematic loop is cut.</p></html>"));
end Spherical;
