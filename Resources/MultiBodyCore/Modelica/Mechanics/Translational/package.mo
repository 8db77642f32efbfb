within Modelica.Mechanics;
package Translational "Drive trains that slide"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Elements with flanges: a position and a cut force. All positions count in the same direction, a positive force pushes that way.</p></html>"));
end Translational;
