within ContactMultiBody;
package Friction "Laws of friction between bodies"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>Tangential forces at contact points from normal force and sliding velocity.</p>
</html>"));
end Friction;
