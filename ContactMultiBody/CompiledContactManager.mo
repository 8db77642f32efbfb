within ContactMultiBody;
model CompiledContactManager "Lets many bodies collide; the engine finds the contacts and computes their forces"
  extends Interfaces.PartialCompiledContacts(
    geometry=collider.geometry,
    material=collider.material,
    inertia=collider.inertia);
  import Modelica.Mechanics.MultiBody.Frames;

  parameter Parts.Collider collider[n] "Geometry, material and inertia of each body, usually {body1.collider, ...}";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame[n] "Frames of the bodies"
    annotation (Placement(transformation(extent={{-116,-80},{-84,80}})));

  Modelica.Units.SI.Force force[n, 3] "Contact force on each body, in world axes";
protected
  Modelica.Units.SI.Torque torque[n, 3] "Contact torque on each body about its frame, in world axes";
  Modelica.Units.SI.Position origin[n, 3] "Origins of the bodies' frames, to be differentiated";
equation
  for i in 1:n loop
    origin[i, :] = frame[i].r_0;
    w_0[i, :] = Frames.resolve1(frame[i].R, frame[i].R.w);
  end for;
  v_0 = der(origin);
  for i in 1:n loop
    assert(not collider[i].isFixed or max(abs(frame[i].r_0 - collider[i].r_0)) < 1e-6,
      "frame[" + String(i) + "] is not where collider[" + String(i) + "] says its Ground or Fixed is: give colliders in the order of the frames.");
  end for;
  r_0 = Internal.Unaliased.vectors({frame[i].r_0 for i in 1:n});
  T = Internal.Unaliased.rotations({frame[i].R.T for i in 1:n});
  force = Internal.Unaliased.vectors(responseForce);
  torque = Internal.Unaliased.vectors(responseTorque);
  for i in 1:n loop
    frame[i].f = -Frames.resolve2(frame[i].R, force[i, :]);
    frame[i].t = -Frames.resolve2(frame[i].R, torque[i, :]);
  end for;
  annotation (
    defaultComponentName="contacts",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,70},{-10,10}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{10,70},{70,10}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Ellipse(extent={{-30,96},{30,36}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,10},{80,-34}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-100,-60},{100,-90}}, textString="n=%n")}),
    Documentation(info="<html>
<p>
Used like the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>, for scenes of many bodies. Instead of a list of
pairs it takes what can never touch; each time, the engine finds the pairs that do touch in nearly linear time, and
computes their forces itself. The model gets the wrench on each body and nothing else, so that the number of its equations
grows with the number of bodies, not of pairs.
</p>
<blockquote><pre>
ContactMultiBody.CompiledContactManager contacts(
  n=3,
  collider=cat(1, ball.collider, {floor.collider}));
</pre></blockquote>
<p>
The laws are those of the ContactManager: all normal laws, with the speed of impact recovered from depth and speed
(<code>RestitutionMethod.Memoryless</code>) or with constant damping; regularised friction, also with Stribeck's curve; spin and
rolling friction. There are no events and no states. The effective mass of a pair is computed from masses, inertia
tensors, the place of the contact and its normal, as the ContactManager does it. What needs memory, anchored friction and caught impact
speeds, is the ContactManager's.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>never touch</th><th>parameter</th></tr>
<tr><td>two immovable bodies</td><td><code>inertia[i].m</code> = 0, as the ground has it</td></tr>
<tr><td>bodies of which one is in no group that the other collides with</td><td><code>group</code>, <code>collidesWith</code>: bits</td></tr>
<tr><td>single pairs, as neighbours in a joint</td><td><code>excluded</code></td></tr>
</table>
<p>
Parameters belong to bodies here, not to pairs: two bodies' stiffnesses act in series, their curvatures add up, and restitution and friction combine by the rules. For
thousands of free bodies see <a href=\"modelica://ContactMultiBody.Parts.FreeBodies\">Parts.FreeBodies</a>.
</p>
</html>"));
end CompiledContactManager;
