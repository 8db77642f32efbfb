within ContactMultiBody.UsersGuide;
class LargeScenes "Many bodies: contacts computed in the engine"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<p>
The <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> has equations for every pair: five bodies are ten
pairs, a hundred are five thousand. From about ten bodies that may all touch, use the
<a href=\"modelica://ContactMultiBody.CompiledContactManager\">CompiledContactManager</a>: the engine finds the pairs that touch and computes
their forces by the same laws. For tens to a thousand equal free bodies there is
<a href=\"modelica://ContactMultiBody.Parts.FreeBodies\">FreeBodies</a>, without frames.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th></th><th>ContactManager</th><th>CompiledContactManager, FreeBodies</th></tr>
<tr><td>equations</td><td>for each pair and point</td><td>six for each body</td></tr>
<tr><td>restitution</td><td>by events or without</td><td>without events, from <code>inertia</code></td></tr>
<tr><td>friction</td><td>none, regularised, anchored</td><td>none, regularised, with Stribeck's curve</td></tr>
<tr><td>spin and rolling friction</td><td>yes</td><td>yes</td></tr>
<tr><td>parameters</td><td>of pairs</td><td>of bodies</td></tr>
<tr><td>shows</td><td>distance, forces, speeds of each pair</td><td>force on each body, sums over the scene</td></tr>
<tr><td>pairs that never touch</td><td>left out of <code>pairs</code></td><td>immovable bodies, groups, <code>excluded</code></td></tr>
</table>
<p>
<strong>Stiffness</strong> decides how long a simulation takes. Impacts last about &pi; sqrt(m/K) with exponent 1, and the integrator needs some ten steps for each: choose K as small as the depth m g/K and
v sqrt(m/K) you can accept. So does <code>regularisationSpeed</code>: the smaller, the stiffer friction is.
</p>
<p>
<strong>Tolerance</strong>: where many bodies settle, contacts begin and end all the time, and each kink of the forces costs an integrator steps, the more the tighter the tolerance is. Such a scene is chaotic, so that a tight tolerance buys no
trajectory, only the same statistics: 64 spheres that fall into a box take 5600 evaluations in 1.5 s at tolerance 1e-2, 10100 at 1e-3, 16700 at 1e-4 and 46400 at 1e-6; their energies in the end differ by 0.5 %, and at most 0.03 % of the kinetic energy is left. 1e-3 is a good choice for heaps, 1e-6 for
single impacts.
</p>
<p>
<strong>Heaps creep</strong> under regularised friction: each contact slides at <code>regularisationSpeed</code> q/sqrt(1 - q<sup>2</sup>) under the share q of its largest friction force, and in a heap some contacts are always near
theirs. So a heap flattens slowly and gives way now and then, however small that speed; smooth bodies that fill a container come to rest, as in SpheresInBox. What must stand is for the ContactManager with anchored friction.
</p>
<p>
Examples: <a href=\"modelica://ContactMultiBody.Examples.TumblingShapes\">TumblingShapes</a>,
<a href=\"modelica://ContactMultiBody.Examples.SpheresOnFloor\">SpheresOnFloor</a>,
<a href=\"modelica://ContactMultiBody.Examples.SpheresInBox\">SpheresInBox</a>.
</p>
</html>"));
end LargeScenes;
