within Modelica.Mechanics.Translational.Sensors;
model PositionSensor "Position of a flange"
  extends Modelica.Mechanics.Translational.Interfaces.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput s(unit="m") "Position of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  s = flange.s;
  annotation (Documentation(info="<html><p>Position of a flange.</p></html>"));
end PositionSensor;
