within ContactMultiBody.UsersGuide;
class ReleaseNotes "Release notes"
  extends Modelica.Icons.ReleaseNotes;
  annotation (DocumentationClass=true, Documentation(info="<html>
<h4>Version 0.1.0</h4>
<p>First version, for the Modelica Standard Library 4.0.0 and 4.1.0:</p>
<ul>
<li>ContactManager, VolumeContactManager and CompiledContactManager; bodies that stand in for those of MultiBody, FreeBody, CollisionShape, Ground.</li>
<li>Shapes: half-space, sphere, box, capsule, cylinder, cone, ellipsoid, hull, triangle mesh, height field, compounds of them.</li>
<li>Ten laws of the normal force with events or without, volume law, stiffness by Hertz or given; friction regularised or anchored, of spin and of rolling.</li>
<li>Eleven materials with their sources.</li>
<li>Contacts of simple shapes in Modelica alone.</li>
<li>Joints that MultiBody has not (screw, couplings, closure of overconstrained loops); drives of joints with their controllers.</li>
</ul>
<p>
Who extended classes of states before this version finds them under new names, with the same parameters and variables; no conversion is needed otherwise. Those states had no number of
their own: tools that convert do so for models that state <code>uses(ContactMultiBody(version=\"0.0.0\"))</code>, by
<a href=\"modelica://ContactMultiBody/Resources/Scripts/ConvertFromBefore0.1.0.mos\">a script</a>. The last line is for the hand: functions are private.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>was</th><th>is</th></tr>
<tr><td>Internal.PartialContacts</td><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialContacts\">Interfaces.PartialContacts</a>; extending models give <code>pairDistance</code> instead of <code>distance</code></td></tr>
<tr><td>Internal.PartialCompiledContacts</td><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialCompiledContacts\">Interfaces.PartialCompiledContacts</a>; extending models read <code>responseForce</code> and <code>responseTorque</code></td></tr>
<tr><td>Internal.intern, query, ...</td><td><a href=\"modelica://ContactMultiBody.Internal\">sub-packages of Internal</a></td></tr>
</table>
<p>
From here on a class, parameter or variable that users see changes its name only with a new version and a line in such a script.
</p>
<p>Changes of the whole project are in its file CHANGELOG.md.</p>
</html>"));
end ReleaseNotes;
