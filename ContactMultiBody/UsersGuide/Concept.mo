within ContactMultiBody.UsersGuide;
class Concept "How collisions are computed"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<p>
A <strong>body</strong> carries two parameters more than its counterpart in Modelica.Mechanics.MultiBody: its <em>geometry</em>, a string
made by a function of <a href=\"modelica://ContactMultiBody.Shapes\">Shapes</a>, and its <em>material</em>. Neither adds an equation; without geometry a body
is exactly that of the Modelica Standard Library.
</p>
<p>
One <strong>ContactManager</strong> is connected to all bodies that may touch. For every pair it asks the contact engine, in one call for the whole
scene, for the signed distance and for the contact points with their depths, normals and weights. From these and the velocities it computes
</p>
<ul>
<li>the normal force of each point, by a law of <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a>,</li>
<li>the friction, by a law of <a href=\"modelica://ContactMultiBody.Friction\">Friction</a>,</li>
</ul>
<p>
and applies the forces at the points, with their torques, to the frames of both bodies.
</p>
<p>
The engine answers as a function of the poses alone. It keeps no state between calls, so that an integrator may evaluate in any order, go back, and run several
instances at once. The scene is made once, when parameters are computed, and known by an Integer handle.
</p>
<p>
<strong>Penetration</strong> is the compliance of the real bodies, lumped into the contact: bodies stay rigid, and overlap by the depth at which their surfaces would give way. The force is a function of this depth and its rate, zero where the contact
begins and never negative. <strong>Restitution</strong> is delivered by a damping factor that is solved from the equation of the impact, <strong>friction</strong> by a spring whose anchor is dragged along when it slips, or by a smooth function of the sliding speed.
</p>
<p>
All choices are <strong>structural</strong>: what a scene does not ask for leaves no equation, no state and no event behind.
</p>
</html>"));
end Concept;
