within ContactMultiBody.Internal;
package Resultants "Sums of the points' forces"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
By pair and by body.
</p>
</html>"));
end Resultants;
