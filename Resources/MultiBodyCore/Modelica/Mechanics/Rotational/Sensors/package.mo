within Modelica.Mechanics.Rotational;
package Sensors "Sensors"
  extends Modelica.Icons.SensorsPackage;
  annotation (Documentation(info="<html><p>Sensors of flanges.</p></html>"));
end Sensors;
