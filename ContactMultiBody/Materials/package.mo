within ContactMultiBody;
package Materials "Materials of bodies that collide"
  extends Modelica.Icons.MaterialPropertiesPackage;

  annotation (Documentation(info="<html>
<p>Elasticity, restitution and friction of single materials, and how two of them combine.</p>
</html>"));
end Materials;
