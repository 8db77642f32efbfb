within Modelica.Mechanics.Translational.Interfaces;
partial model PartialRelativeSensor "Sensor between two flanges"
  extends Modelica.Icons.RectangularSensor;
  extends PartialTwoFlanges;
equation
  0 = flange_a.f + flange_b.f;
  annotation (Documentation(info="<html><p>Base class of sensors that pass a force on.</p></html>"));
end PartialRelativeSensor;
