within Modelica;
package Blocks "Input/output blocks"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Blocks that compute signals: sources, mathematics, linear and nonlinear elements, as far as drives need them.</p></html>"));
end Blocks;
