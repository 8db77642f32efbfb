within Modelica.Blocks;
package Nonlinear "Nonlinear elements"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Limits and dead zones.</p></html>"));
end Nonlinear;
