within ContactMultiBody.Internal;
package NormalForces "Normal forces of all points, and the energy of their springs"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
The laws of <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> at each point.
</p>
</html>"));
end NormalForces;
