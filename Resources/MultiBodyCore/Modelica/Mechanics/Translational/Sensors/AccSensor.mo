within Modelica.Mechanics.Translational.Sensors;
model AccSensor "Acceleration of a flange"
  extends Modelica.Mechanics.Translational.Interfaces.PartialAbsoluteSensor;
  SI.Velocity v "Velocity of the flange";
  Modelica.Blocks.Interfaces.RealOutput a(unit="m/s2") "Acceleration of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  v = der(flange.s);
  a = der(v);
  annotation (Documentation(info="<html><p>Acceleration of a flange.</p></html>"));
end AccSensor;
