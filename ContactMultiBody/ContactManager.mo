within ContactMultiBody;
model ContactManager "Lets all bodies it is connected to collide"
  extends Interfaces.PartialContacts(final thickness=Internal.Engine.pairThicknesses(scene, m));

  parameter String geometry[n]=collider.geometry "Descriptor of each body's geometry, if not given by collider";
  parameter Types.Backend backend=Types.Backend.Automatic "Algorithm that finds the contacts"
    annotation (Evaluate=true, Dialog(tab="Advanced"));
  parameter Modelica.Units.SI.Length exactWithin(min=Modelica.Constants.small)=Modelica.Constants.inf
    "Gap between bounding volumes up to which distances are exact; beyond it they are lower bounds, which cost less"
    annotation (Dialog(tab="Advanced"));
  final parameter Integer scene=Internal.Engine.intern(geometry, pair, Integer(backend) - 1) "Handle of the scene in the engine";
protected
  final parameter Boolean canTouch=Internal.canCollide(geometry, pair) "= true, if a pair has two geometries";
equation
  assert(canTouch,
    "Nothing can touch: no pair of the manager's bodies has two geometries. Give collider={body1.collider, ...}, or geometry and material, and shapes to the bodies.");
  (pairDistance,depth,weight,normal,point) = Internal.Engine.query(
    scene,
    {frame[i].r_0 for i in 1:n},
    {frame[i].R.T for i in 1:n},
    m,
    pointCapacity,
    exactWithin);
  annotation (
    defaultComponentName="contacts",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-40,80},{40,0}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,4},{80,-40}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{0,4},{0,70}}, color={255,0,0}, thickness=0.5, arrow={Arrow.None,Arrow.Filled}),
        Text(extent={{-100,-60},{100,-90}}, textString="n=%n")}),
    Documentation(info="<html>
<p>
Connect a frame of each body that may collide to an element of <code>frame</code>, and give what the manager has to know about the bodies, their
<a href=\"modelica://ContactMultiBody.Parts.Collider\">colliders</a>, in the same order:
</p>
<blockquote><pre>
ContactMultiBody.Parts.FreeBody ball(geometry=ContactMultiBody.Shapes.sphere(0.1), ...);
ContactMultiBody.Parts.Ground floor;
ContactMultiBody.ContactManager contacts(
  n=2,
  collider={ball.collider, floor.collider});
equation
connect(ball.frame_a, contacts.frame[1]);
connect(floor.frame_a, contacts.frame[2]);
</pre></blockquote>
<p>
<code>geometry</code>, <code>material</code> and <code>inertia</code> can be given instead, one list each. A connector that carries these along with the frame is not possible: parameters of a connector belong to each of its two sides,
and Modelica passes none of them through a connection. See <a href=\"modelica://ContactMultiBody.Parts.Collider\">Collider</a> for what notices a list in a wrong order.
</p>
<p>
The geometry of a body is described in the frame that is connected. By default all pairs of bodies may touch;
<code>pairs={{1,3},{2,3}}</code> names those that are to be looked at, which saves time.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>variable, for each pair i</th><th>meaning</th></tr>
<tr><td><code>distance[i]</code></td><td>signed distance, negative when the bodies penetrate; a lower bound where a finite <code>exactWithin</code> is exceeded</td></tr>
<tr><td><code>relativeDepth</code></td><td>largest depth by the thickness of the thinner body (one for the scene); from 1/2 on a warning names the pair</td></tr>
<tr><td><code>normalForce[i]</code></td><td>normal force, summed over the points</td></tr>
<tr><td><code>force[i,:]</code></td><td>force on the first body of the pair, in world axes</td></tr>
<tr><td><code>approachSpeed[i]</code></td><td>speed along the normal where the bodies touch or will touch, positive when they approach</td></tr>
<tr><td><code>impactSpeed[i]</code></td><td>approach speed when the contact started or was struck anew; exists where impacts are caught by events</td></tr>
<tr><td><code>touches[i]</code></td><td>= true, if the bodies touch, from a depth of 1e-10 m on until they part; exists where impacts are caught by events</td></tr>
<tr><td><code>anchorStretch[i,:]</code></td><td>stretch of the static friction springs: translation (1:3), turning times radius of gyration (4:6); exists with anchored friction</td></tr>
<tr><td><code>elasticEnergy</code></td><td>energy stored in all contacts (one for the scene)</td></tr>
</table>
<p>
The force of a contact point is F = weight K x<sup>n</sup>(1 + d/v<sub>0</sub> dx/dt), never negative, with the approach speed at that
point; the weights of a face that carries wholly sum to one. See
<a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> and <a href=\"modelica://ContactMultiBody.Friction\">Friction</a> for the laws.
</p>
<p>
<strong>Distances of bodies far apart</strong> need not be exact for contacts, and finding them costs time. With a finite <code>exactWithin</code>, a length L,
<code>distance</code> is exact where the gap g between the bounding volumes (spheres and boxes) of the two shapes is at most L, that gap where it is at least 2 L, and fades smoothly
between; <code>approachSpeed</code> is then taken along the line of centres. Bodies of several shapes are bounded as a whole first: where these bounds are 2 L apart,
their gap is the distance, and no shape is looked at. It is never more than the true distance and has its sign, so that forces are the same at
each pose and impacts happen at the same times. It is no clearance to read off: leave the default, infinity, where clearances are wanted.
See <a href=\"modelica://ContactMultiBody.UsersGuide.EffectsAndLaws\">Which effects and laws to choose</a> for what it saves.
</p>
<p>
All choices are structural: without friction there are no tangential forces, without restitution no events, without anchored friction no states.
See <a href=\"modelica://ContactMultiBody.UsersGuide.EffectsAndLaws\">Which effects and laws to choose</a>.
</p>
</html>"));
end ContactManager;
