within Modelica.Mechanics.Rotational;
package Interfaces "Flanges and partial elements"
  extends Modelica.Icons.InterfacesPackage;
  annotation (Documentation(info="<html><p>The connectors of shafts, and the partial models that have them.</p></html>"));
end Interfaces;
