within ContactMultiBody.Actuators;
package Rotational "Drives, passive elements and sensors of revolute joints"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
Components between the <code>axis</code> of a revolute joint of Modelica.Mechanics.MultiBody (with <code>useAxisFlange = true</code>) and its
<code>support</code>. Several may be connected to one joint; of those that force a motion (Position) only one.
</p>
</html>"));
end Rotational;
