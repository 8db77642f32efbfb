within ContactMultiBody.Internal;
package Engine "External functions of the contact engine"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
Called with poses and velocities, they answer for a whole scene; see external-c in the project.
</p>
</html>"));
end Engine;
