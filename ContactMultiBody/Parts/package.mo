within ContactMultiBody;
package Parts "Bodies that can collide"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
The bodies of Modelica.Mechanics.MultiBody.Parts with two more parameters, geometry and material. A body without
geometry is exactly the body of the Modelica Standard Library.
</p>
</html>"));
end Parts;
