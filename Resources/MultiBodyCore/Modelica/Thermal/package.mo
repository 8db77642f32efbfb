within Modelica;
package Thermal "Heat"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>The connector through which elements with friction give off heat.</p></html>"));
end Thermal;
