within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialAbsoluteSensor "Sensor of one flange"
  extends Modelica.Icons.RoundSensor;
  Flange_a flange "Flange that is measured" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
equation
  0 = flange.tau;
  annotation (Documentation(info="<html><p>Base class of sensors that take no torque.</p></html>"));
end PartialAbsoluteSensor;
