within ContactMultiBody.Internal;
package Kinematics "How bodies move against each other at contact points"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
One row a pair, one column a point.
</p>
</html>"));
end Kinematics;
