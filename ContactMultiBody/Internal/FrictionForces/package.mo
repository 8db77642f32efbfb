within ContactMultiBody.Internal;
package FrictionForces "Forces and torques of friction of all pairs"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
The laws of <a href=\"modelica://ContactMultiBody.Friction\">Friction</a> at each pair or point.
</p>
</html>"));
end FrictionForces;
