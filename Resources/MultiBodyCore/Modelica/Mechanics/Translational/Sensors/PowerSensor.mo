within Modelica.Mechanics.Translational.Sensors;
model PowerSensor "Power between two flanges"
  extends Modelica.Mechanics.Translational.Interfaces.PartialRelativeSensor;
  Modelica.Blocks.Interfaces.RealOutput power(unit="W") "Power that flange_a takes" annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={0,-110})));
equation
  flange_a.s = flange_b.s;
  power = flange_a.f*der(flange_a.s);
  annotation (Documentation(info="<html><p>Power that passes from flange_a to flange_b; the two move as one.</p></html>"));
end PowerSensor;
