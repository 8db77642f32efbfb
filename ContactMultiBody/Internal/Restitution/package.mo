within ContactMultiBody.Internal;
package Restitution "What makes contacts deliver their coefficients of restitution"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
Damping factors, speeds of impacts, and how fast springs slow bodies down.
</p>
</html>"));
end Restitution;
