within Modelica.Mechanics.Translational.Sensors;
model ForceSensor "Force between two flanges"
  extends Modelica.Mechanics.Translational.Interfaces.PartialRelativeSensor;
  Modelica.Blocks.Interfaces.RealOutput f(unit="N") "Force that flange_a takes" annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={0,-110})));
equation
  flange_a.s = flange_b.s;
  f = flange_a.f;
  annotation (Documentation(info="<html><p>Force that passes from flange_a to flange_b; the two move as one.</p></html>"));
end ForceSensor;
