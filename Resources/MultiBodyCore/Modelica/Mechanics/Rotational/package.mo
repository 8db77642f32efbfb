within Modelica.Mechanics;
package Rotational "Drive trains that turn"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Elements with flanges: an angle and a cut torque. All angles count in the same direction, a positive torque turns that way.</p></html>"));
end Rotational;
