within ContactMultiBody.UsersGuide;
class GettingStarted "From nothing to a bouncing ball in five steps"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<p>
You need this package, the Modelica Standard Library 4.0 or 4.1 and a Modelica tool, or the program <code>cmb</code> of this project, which needs neither a tool nor the Standard Library.
</p>
<h4>1. A world</h4>
<p>Make a new model and drag <em>Modelica.Mechanics.MultiBody.World</em> into it. Let gravity point down the z axis.</p>
<blockquote><pre>
model Bounce
  inner Modelica.Mechanics.MultiBody.World world(n={0,0,-1});
end Bounce;
</pre></blockquote>
<h4>2. A body</h4>
<p>
Add a <a href=\"modelica://ContactMultiBody.Parts.FreeBody\">FreeBody</a>, a body that no joint holds; its parameters and start values are those of MultiBody's body. Let it start at rest one metre up.
</p>
<blockquote><pre>
ContactMultiBody.Parts.FreeBody ball(
  m=1, r_CM={0,0,0}, I_11=0.004, I_22=0.004, I_33=0.004,
  r_0(start={0,0,1}, each fixed=true), v_0(each fixed=true), angles_fixed=true, w_0_fixed=true);
</pre></blockquote>
<h4>3. A shape and a material</h4>
<p>
Two more parameters make it collide: a geometry, made by a function of <a href=\"modelica://ContactMultiBody.Shapes\">Shapes</a> in the frame that you will connect, and a material of
<a href=\"modelica://ContactMultiBody.Materials\">Materials</a>. Both add no equation.
</p>
<blockquote><pre>
  geometry=ContactMultiBody.Shapes.sphere(0.1), material=ContactMultiBody.Materials.Rubber(restitution=0.7)
</pre></blockquote>
<h4>4. A floor</h4>
<p>A <a href=\"modelica://ContactMultiBody.Parts.Ground\">Ground</a> is a half-space that nothing can pass, by default below z = 0.</p>
<blockquote><pre>
ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Concrete(restitution=0.7));
</pre></blockquote>
<h4>5. A contact manager, connected</h4>
<p>
Add one <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> for the scene. Give it the bodies' colliders, that is geometry, material and inertia in one, in the order in which you connect the bodies.
</p>
<blockquote><pre>
ContactMultiBody.ContactManager contacts(
  n=2,
  collider={ball.collider, floor.collider},
  stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given, stiffness={1e6});
equation
connect(ball.frame_a, contacts.frame[1]);
connect(floor.frame_a, contacts.frame[2]);
</pre></blockquote>
<p>
Simulate for 3 s at tolerance 1e-6 with a solver for stiff models with events, and plot <code>ball.r_0[3]</code>: the ball rises to 0.49 of its height each time, 0.7 squared, and rests at
m g/K below its radius. Then plot <code>contacts.normalForce[1]</code> and <code>contacts.impactSpeed[1]</code>. The finished model is
<a href=\"modelica://ContactMultiBody.Examples.BallOnFloor\">BallOnFloor</a>.
</p>
<h4>Without a Modelica tool</h4>
<blockquote><pre>
cmb fmu Bounce --source Bounce.mo
cmb simulate Bounce.fmu --stop 3 --output bounce.csv
cmb report bounce.csv --output bounce.html
</pre></blockquote>
<h4>From here</h4>
<ul>
<li>Bodies on joints: <a href=\"modelica://ContactMultiBody.Parts.Body\">Body</a>, MultiBody's own with a geometry and a material.</li>
<li>Mechanisms that exist: exchange <code>Modelica.Mechanics.MultiBody.Parts</code> for <code>ContactMultiBody.Parts</code>; nothing else changes until a manager is connected. Frames without a body of their own get a
<a href=\"modelica://ContactMultiBody.Parts.CollisionShape\">CollisionShape</a>.</li>
<li>Several shapes on one body: <a href=\"modelica://ContactMultiBody.Shapes.compound\">compound</a>. Only pairs that can meet: <code>pairs</code>.</li>
<li><a href=\"modelica://ContactMultiBody.UsersGuide.EffectsAndLaws\">Which effects and laws to choose</a>, <a href=\"modelica://ContactMultiBody.UsersGuide.Numerics\">what limits accuracy</a>.</li>
</ul>
</html>"));
end GettingStarted;
