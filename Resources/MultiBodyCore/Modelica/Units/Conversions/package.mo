within Modelica.Units;
package Conversions "Conversions between units"
  extends Modelica.Icons.FunctionsPackage;
  annotation (Documentation(info="<html><p>Functions that convert to and from units outside the SI.</p></html>"));
end Conversions;
