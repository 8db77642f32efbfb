within ContactMultiBody.NormalForce;
package Internal "What the laws share"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>Interface of the functions that give a damping factor.</p>
</html>"));
end Internal;
