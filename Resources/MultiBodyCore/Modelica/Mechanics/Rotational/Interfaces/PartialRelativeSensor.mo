within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialRelativeSensor "Sensor between two flanges"
  extends Modelica.Icons.RoundSensor;
  Flange_a flange_a "First flange" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Flange_b flange_b "Second flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  0 = flange_a.tau + flange_b.tau;
  annotation (Documentation(info="<html><p>Base class of sensors that pass a torque on.</p></html>"));
end PartialRelativeSensor;
