within Modelica.Mechanics.Rotational.Sensors;
model AccSensor "Angular acceleration of a flange"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialAbsoluteSensor;
  SI.AngularVelocity w "Angular velocity of the flange";
  Modelica.Blocks.Interfaces.RealOutput a(unit="rad/s2") "Angular acceleration of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  w = der(flange.phi);
  a = der(w);
  annotation (Documentation(info="<html><p>Angular acceleration of a flange.</p></html>"));
end AccSensor;
