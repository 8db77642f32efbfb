within ContactMultiBody.UsersGuide;
class Numerics "Solvers, steps and what limits accuracy"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<h4>Settings</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>setting</th><th>value</th><th>why</th></tr>
<tr><td>solver</td><td>DASSL, IDA, CVODE (BDF), Radau</td><td>contact is stiff; explicit methods take steps of sqrt(m/K)</td></tr>
<tr><td>tolerance</td><td>1e-6</td><td>restitution is delivered within 0.001, stops and rolling within 0.1 %; at 1e-4 too in co-simulation and by cmb simulate, which hold short steps to less than a tenth of the tolerance; by other solvers within 0.006, as each of the fifty steps of an impact may err by 1e-4 of the speed</td></tr>
<tr><td>longest step</td><td>thickness of the thinnest wall by the greatest speed</td><td>other tools see nothing of what happens within one step; half-spaces need no limit. FMUs of this project find bodies that pass through each other within a step, and need none</td></tr>
<tr><td>output interval</td><td>some rows in a contact time, &pi; sqrt(m/K)</td><td>only for plots of forces; the solver chooses its own steps</td></tr>
<tr><td>co-simulation</td><td>an FMU with its own implicit solver</td><td>explicit Euler at the communication step diverges</td></tr>
</table>
<h4>What to know</h4>
<ul>
<li>Contact is stiff while bodies touch and absent otherwise. Use an implicit variable-step solver (DASSL, CVODE, IDA, Radau) with event detection.</li>
<li>The force is continuous in depth and speed: zero where a contact begins, never negative, bounded damping for contacts that start at rest. Manifolds change continuously with the pose. An
error-controlled solver therefore needs no tolerance below 1e-6 for its own sake.</li>
<li>The event at the start of a contact is found by the sign of the signed distance. If a body crosses a thin wall within one step, other tools do not see it: limit the step to thickness by speed, or give thin walls
as half-spaces, which nothing can pass. FMUs of this project look at the ways of bodies within each step and go back to where they meet.</li>
<li>The solution of the law is exact for a free impact. Gravity, joints and other contacts act during an impact as well; their share is of the order of g sqrt(m/K)/v<sub>0</sub>, so that slow bounces lose more than e says. Below
<code>restSpeed</code> the damping rises until bounces die.</li>
<li>The speed of impact is caught by an event at the first touch. <code>touches</code> tells of it later, 1e-10 m deep and past the hysteresis of events (in FMUs of this project 1e-10 m more, or a millionth of the
tolerance): the speed there counts, unless the contact has slowed the pair down by a hundredth since. Contacts 7 to 20 widths deep may so lose 0.5 % of e.</li>
<li>It is caught again when a point of a touching pair meets more than a quarter faster than before: as when a box falls flat
after landing on its edge, or when something strikes a body that rests. A second strike at the share s of the first speed, while the pair still touches, keeps the first speed v<sub>0</sub>: no other choice for the pair leaves the force of
its other points as it is. The damping factor then counts as s d, so that the strike comes back with the restitution that s d delivers
(<a href=\"modelica://ContactMultiBody.NormalForce.deliveredRestitution\">deliveredRestitution</a>): more than e, less than 1.
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>second speed by first</th><th>1</th><th>0.8</th><th>0.5</th><th>0.3</th><th>0.1</th></tr>
<tr><td>e = 0.1</td><td>0.100</td><td>0.125</td><td>0.197</td><td>0.307</td><td>0.594</td></tr>
<tr><td>e = 0.3</td><td>0.300</td><td>0.356</td><td>0.480</td><td>0.613</td><td>0.829</td></tr>
<tr><td>e = 0.5</td><td>0.500</td><td>0.559</td><td>0.673</td><td>0.776</td><td>0.913</td></tr>
<tr><td>e = 0.7</td><td>0.700</td><td>0.745</td><td>0.825</td><td>0.887</td><td>0.959</td></tr>
</table>
With <code>Memoryless</code> each point recovers its own speed, and each strike delivers e.</li>
<li>A contact that exists when the simulation starts is taken to have started at the speed it then has. Bodies that overlap at rest then part slowly, at <code>restSpeed</code>/20 at most; with
<code>Memoryless</code>, and in the CompiledContactManager, the energy of the overlap shoots them apart. Look at <code>contacts.distance</code> at the start when bodies creep out of each other or fly off.</li>
<li>Anchored friction is elastic up to 0.9 of its limit: displacement under load is F/S and goes back. It does not creep.</li>
<li>Depth at rest is m g/K (exponent 1), shared by the points of a face.</li>
</ul>
</html>"));
end Numerics;
