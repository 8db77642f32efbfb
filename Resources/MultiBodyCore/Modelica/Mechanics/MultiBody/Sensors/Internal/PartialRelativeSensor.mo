within Modelica.Mechanics.MultiBody.Sensors.Internal;
partial model PartialRelativeSensor "Sensor between two frames"
  extends Modelica.Icons.RoundSensor;
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame that is measured from"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b "Frame that is measured"
    annotation (Placement(transformation(extent={{84,-16},{116,16}})));
  annotation (Documentation(info="<html><p>Base class of sensors between two frames.</p></html>"));
end PartialRelativeSensor;
