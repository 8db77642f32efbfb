within ContactMultiBody;
package Interfaces "What contact managers extend, one concern a class"
  extends Modelica.Icons.InterfacesPackage;

  annotation (Documentation(info="<html>
<p>
Extend <a href=\"modelica://ContactMultiBody.Interfaces.PartialContacts\">PartialContacts</a> for a geometry of your own: the extending model gives depths, normals and points, and
inherits laws, parameters and variables. It is built up step by step; each class holds parameters, variables and equations of one concern and extends the one before:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>class</th><th>concern</th></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialPairs\">PartialPairs</a></td><td>bodies, pairs, and how they move where they touch</td></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialRestitution\">PartialRestitution</a></td><td>what an impact gives back, and the events that catch its speed</td></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialNormalForce\">PartialNormalForce</a></td><td>stiffness and damping along the normal</td></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialFriction\">PartialFriction</a></td><td>friction against sliding</td></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialTurningFriction\">PartialTurningFriction</a></td><td>friction against spin and rolling</td></tr>
<tr><td><a href=\"modelica://ContactMultiBody.Interfaces.PartialContacts\">PartialContacts</a></td><td>forces and torques on the bodies</td></tr>
</table>
<p>
<a href=\"modelica://ContactMultiBody.Interfaces.PartialCompiledContacts\">PartialCompiledContacts</a> stands by itself: the engine computes its forces.
</p>
</html>"));
end Interfaces;
