within Modelica.Mechanics.MultiBody;
package Sensors "Sensors"
  extends Modelica.Icons.SensorsPackage;
  annotation (Documentation(info="<html><p>Sensors of motion and of cut forces.</p></html>"));
end Sensors;
