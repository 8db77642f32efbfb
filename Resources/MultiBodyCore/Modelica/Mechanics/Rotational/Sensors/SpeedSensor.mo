within Modelica.Mechanics.Rotational.Sensors;
model SpeedSensor "Angular velocity of a flange"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput w(unit="rad/s") "Angular velocity of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  w = der(flange.phi);
  annotation (Documentation(info="<html><p>Angular velocity of a flange.</p></html>"));
end SpeedSensor;
