within ContactMultiBody.UsersGuide;
class EffectsAndLaws "Which effects and laws to choose"
  extends Modelica.Icons.Information;
  annotation (DocumentationClass=true, Documentation(info="<html>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>question</th><th>choice</th><th>costs</th></tr>
<tr><td>Do bodies bounce, and do you know by how much?</td><td><code>useRestitution=true</code>, law <code>Exact</code> (the default)</td><td>one event at the start of each contact</td></tr>
<tr><td>The same, but without events?</td><td><code>restitutionMethod=Memoryless</code> with <code>inertia={body1.inertia, ...}</code></td><td>about 500 operations a point; exact where the bodies are not held by joints or other contacts</td></tr>
<tr><td>Do bodies only rest, push and slide?</td><td><code>useRestitution=false</code> with <code>steadyRate</code></td><td>nothing</td></tr>
<tr><td>Are stiffness and damping given, as of a buffer?</td><td><code>normalLaw=SpringDamper</code></td><td>nothing</td></tr>
<tr><td>Does friction only brake or drive?</td><td><code>friction=Regularised</code></td><td>nothing; creeps under load</td></tr>
<tr><td>Must friction hold?</td><td><code>friction=Anchored</code></td><td>six states a pair</td></tr>
<tr><td>Is friction without interest?</td><td><code>friction=None</code></td><td>saves its equations</td></tr>
<tr><td>Do balls spin or roll to rest?</td><td><code>useTurningFriction=true</code> with <code>spinRadius</code>, <code>rollingLever</code></td><td>a torque a point</td></tr>
</table>
<p>
<strong>Laws of the normal force</strong>: <code>Exact</code> delivers the restitution that is asked for; the published laws are there to reproduce results that were made with them, and
deliver what the table in <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> says. <code>SpringDamper</code> is for elements whose constants were measured. All of them take any exponent from 1 on: 1 for
flat faces and where nothing is known, 3/2 for round bodies (Hertz).
</p>
<p>
<strong>Points or volumes</strong>: the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> knows all shapes and gives a face four or more points. Where the distribution of pressure over a
face matters, as on rubber, mats and pads, the <a href=\"modelica://ContactMultiBody.VolumeContactManager\">VolumeContactManager</a> takes forces from the volume of the overlap, for all shapes but open meshes and height fields.
</p>
<p>
<strong>Many bodies</strong>: the <a href=\"modelica://ContactMultiBody.CompiledContactManager\">CompiledContactManager</a> computes forces in the engine, for scenes of tens or hundreds of bodies.
</p>
<p>
<strong>Stiffness</strong>: with <code>stiffnessChoice=Hertz</code> it follows from the materials and <code>contactRadius</code>, the radius of curvature of the contact (the radius of a sphere on a plane), with exponent
3/2. Real metals are so stiff that impacts last tens of microseconds; where only the motion between contacts matters, choose a <code>stiffness</code> that lets bodies
penetrate by a depth you can accept: K = m v<sup>2</sup>/x<sup>2</sup> for an impact, K = m g/x at rest (exponent 1). The restitution delivered does not depend on it.
</p>
<p>
<strong>Regularised friction</strong> creeps: under a load that is the share q of the largest friction force at <code>regularisationSpeed</code> q/sqrt(1 - q<sup>2</sup>). So this parameter is the creep you
accept, and its default, 1 mm/s, suits what slides or rolls. A smaller one costs evaluations; at tolerance 1e-6 these:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th><code>regularisationSpeed</code>, m/s</th><th>1e-2</th><th>1e-3</th><th>1e-4</th><th>1e-5</th><th>1e-6</th></tr>
<tr><td>BoxOnIncline</td><td>421</td><td>450</td><td>440</td><td>528</td><td>492</td></tr>
<tr><td>BoxOnEdge, regularised</td><td>2878</td><td>3171</td><td>3930</td><td>4528</td><td>5915</td></tr>
<tr><td>StackOfBoxes, regularised</td><td>2535</td><td>3624</td><td>4707</td><td>5404</td><td>6058</td></tr>
<tr><td>RollingSphere</td><td>265</td><td>265</td><td>517</td><td>551</td><td>1858949</td></tr>
<tr><td>BallOnTerrain</td><td>19322</td><td>27265</td><td>37448</td><td>52851</td><td>gives up</td></tr>
</table>
<p>
Below the tolerance times the greatest speed the sliding of a rolling body drowns in the error that the integrator is allowed, and its steps become tiny. Bodies that stand or slide may go down to 1e-6 m/s, where they
creep by less than 0.01 mm/s up to 0.99 of the largest friction force. What must not creep at all is for anchored friction.
</p>
<p>
<strong>Pairs</strong>: restitution and friction belong to pairs of materials. The rules that combine materials are for want of better; measured values go to <code>restitution</code>,
<code>muStatic</code> and <code>muDynamic</code> of the ContactManager.
</p>
<p>
<strong>Distances of pairs far apart</strong>: <code>exactWithin</code> of the ContactManager and the VolumeContactManager, 0.1 m say, lets the engine answer with the gap of bounding volumes where bodies are farther apart. Forces and impacts stay the same;
<code>distance</code> is no clearance to read off then. One evaluation of a model of bodies of 1 m, 3 m apart, that may all touch, microseconds:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>bodies</th><th>pairs</th><th>exact</th><th><code>exactWithin=0.1</code></th></tr>
<tr><td>5 boxes</td><td>10</td><td>14.0</td><td>10.8</td></tr>
<tr><td>10 boxes</td><td>45</td><td>27.5</td><td>17.2</td></tr>
<tr><td>10 cylinders</td><td>45</td><td>65.4</td><td>18.2</td></tr>
<tr><td>10 spheres</td><td>45</td><td>18.9</td><td>17.8</td></tr>
</table>
<p>
What is left are the equations of the pairs. Mechanisms with few pairs gain nothing, nor do bodies whose bounding volumes overlap; pairs that never meet are better left out of <code>pairs</code>.
The CompiledContactManager gives no distances and looks at near bodies alone; the distances of <a href=\"modelica://ContactMultiBody.PureModelica\">PureModelica</a> are closed forms that cost no more than bounds.
</p>
<p>
<strong>Points</strong>: <code>pointCapacity</code> is the largest number of points the engine returns for a pair. 1 suffices for spheres; faces need 4 at least to stand without rocking.
</p>
</html>"));
end EffectsAndLaws;
