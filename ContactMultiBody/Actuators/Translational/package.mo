within ContactMultiBody.Actuators;
package Translational "Drives, passive elements and sensors of prismatic joints"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
Components between the <code>axis</code> of a prismatic joint of Modelica.Mechanics.MultiBody (with <code>useAxisFlange = true</code>) and its
<code>support</code>. Several may be connected to one joint; of those that force a motion (Position) only one.
</p>
</html>"));
end Translational;
