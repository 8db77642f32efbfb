within Modelica.Mechanics.Rotational.Sensors;
model TorqueSensor "Torque between two flanges"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialRelativeSensor;
  Modelica.Blocks.Interfaces.RealOutput tau(unit="N.m") "Torque that flange_a takes" annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={0,-110})));
equation
  flange_a.phi = flange_b.phi;
  tau = flange_a.tau;
  annotation (Documentation(info="<html><p>Torque that passes from flange_a to flange_b; the two move as one.</p></html>"));
end TorqueSensor;
