within Modelica.Thermal.HeatTransfer;
package Interfaces "Heat ports and partial elements"
  extends Modelica.Icons.InterfacesPackage;
  annotation (Documentation(info="<html><p>The connector of heat and the partial models of elements that give off heat.</p></html>"));
end Interfaces;
