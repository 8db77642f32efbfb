within ContactMultiBody.Shapes;
package Internal "Parts of descriptors"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>Functions that write the parts all descriptors share.</p>
</html>"));
end Internal;
