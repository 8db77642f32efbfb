within Modelica.Mechanics.Translational.Interfaces;
partial model PartialAbsoluteSensor "Sensor of one flange"
  extends Modelica.Icons.RectangularSensor;
  Flange_a flange "Flange that is measured" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
equation
  0 = flange.f;
  annotation (Documentation(info="<html><p>Base class of sensors that take no force.</p></html>"));
end PartialAbsoluteSensor;
