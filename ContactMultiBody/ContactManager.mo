within ContactMultiBody;
model ContactManager "Lets all bodies it is connected to collide"
  extends Internal.PartialContacts;

  parameter String geometry[n] "Descriptor of each body's geometry, usually {body1.geometry, ...}";
  parameter Types.Backend backend=Types.Backend.Automatic "Algorithm that finds the contacts"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  final parameter Integer scene=Internal.intern(geometry, pair, Integer(backend) - 1) "Handle of the scene in the engine";
equation
  (distance,depth,weight,normal,point) = Internal.query(scene, r_0, {frame[i].R.T for i in 1:n}, m, pointCapacity);
  annotation (
    defaultComponentName="contacts",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40,80},{40,0}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,4},{80,-40}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{0,4},{0,70}}, color={255,0,0}, thickness=0.5, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-150,150},{150,110}}, textString="%name", textColor={0,0,255}),
        Text(extent={{-100,-60},{100,-90}}, textString="n=%n")}),
    Documentation(info="<html>
<p>
Connect a frame of each body that may collide to an element of <code>frame</code>, and give the bodies' geometries and
materials in the same order:
</p>
<blockquote><pre>
ContactMultiBody.Parts.Body ball(geometry=ContactMultiBody.Shapes.sphere(0.1), ...);
ContactMultiBody.Parts.Ground floor;
ContactMultiBody.ContactManager contacts(
  n=2,
  geometry={ball.geometry, floor.geometry},
  material={ball.material, floor.material});
equation
connect(ball.frame_a, contacts.frame[1]);
connect(floor.frame_a, contacts.frame[2]);
</pre></blockquote>
<p>
The geometry of a body is described in the frame that is connected. By default all pairs of bodies may touch;
<code>pairs={{1,3},{2,3}}</code> names those that are to be looked at, which saves time.
</p>
<p>
The force of a contact point is F = weight K x<sup>n</sup>(1 + d/v<sub>0</sub> dx/dt), never negative, with the approach speed at that
point; the weights of a face that carries wholly sum to one. See
<a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> and <a href=\"modelica://ContactMultiBody.Friction\">Friction</a> for the laws.
</p>
<p>
All choices are structural: without friction there are no tangential forces, without restitution no events.
<code>touches</code> and <code>impactSpeed</code> exist where impacts are caught by events, <code>anchorStretch</code> with anchored friction.
</p>
</html>"));
end ContactManager;
