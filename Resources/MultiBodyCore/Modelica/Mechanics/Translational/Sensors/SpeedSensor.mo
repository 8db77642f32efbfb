within Modelica.Mechanics.Translational.Sensors;
model SpeedSensor "Velocity of a flange"
  extends Modelica.Mechanics.Translational.Interfaces.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput v(unit="m/s") "Velocity of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  v = der(flange.s);
  annotation (Documentation(info="<html><p>Velocity of a flange.</p></html>"));
end SpeedSensor;
