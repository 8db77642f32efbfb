within Modelica.Mechanics.MultiBody;
package Interfaces "Frames and partial models"
  extends Modelica.Icons.InterfacesPackage;
  annotation (Documentation(info="<html><p>The connector of three-dimensional mechanics, and the partial models that have it.</p></html>"));
end Interfaces;
