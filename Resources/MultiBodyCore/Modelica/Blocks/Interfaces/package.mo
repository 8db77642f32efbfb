within Modelica.Blocks;
package Interfaces "Connectors and partial blocks"
  extends Modelica.Icons.InterfacesPackage;
  annotation (Documentation(info="<html><p>The connectors of signals, and the partial blocks that have them.</p></html>"));
end Interfaces;
