within Modelica.Mechanics.MultiBody.Sensors.Internal;
partial model PartialAbsoluteSensor "Sensor of one frame"
  extends Modelica.Icons.RoundSensor;
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame that is measured"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  annotation (Documentation(info="<html><p>Base class of sensors with one frame.</p></html>"));
end PartialAbsoluteSensor;
