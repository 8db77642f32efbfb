within Modelica.Blocks;
package Continuous "Linear elements with states"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Integrators, filters and controllers.</p></html>"));
end Continuous;
