within Modelica.Mechanics.Rotational.Sensors;
model AngleSensor "Angle of a flange"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput phi(unit="rad", displayUnit="deg") "Angle of the flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  phi = flange.phi;
  annotation (Documentation(info="<html><p>Angle of a flange.</p></html>"));
end AngleSensor;
