within ContactMultiBody.UsersGuide;
class ReleaseNotes "Release notes"
  extends Modelica.Icons.ReleaseNotes;
  annotation (DocumentationClass=true, Documentation(info="<html>
<h4>Version 0.1.0</h4>
<p>First version, for the Modelica Standard Library 4.0.0 and 4.1.0:</p>
<ul>
<li>ContactManager, VolumeContactManager and CompiledContactManager; bodies that stand in for those of MultiBody, CollisionShape, Ground.</li>
<li>Shapes: half-space, sphere, box, capsule, cylinder, cone, ellipsoid, hull, triangle mesh, height field, compounds of them.</li>
<li>Ten laws of the normal force with events or without, volume law, stiffness by Hertz or given; friction regularised or anchored, of spin and of rolling.</li>
<li>Eleven materials with their sources.</li>
<li>Contacts of simple shapes in Modelica alone.</li>
<li>Joints that MultiBody has not (screw, couplings, closure of overconstrained loops); drives of joints with their controllers.</li>
</ul>
<p>Changes of the whole project are in its file CHANGELOG.md.</p>
</html>"));
end ReleaseNotes;
