within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialCompliant "Component without inertia between two flanges"
  SI.Angle phi_rel(start=0) "Angle of flange_b less that of flange_a";
  SI.Torque tau "Torque on flange_b";
  Flange_a flange_a "First flange" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Flange_b flange_b "Second flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
equation
  phi_rel = flange_b.phi - flange_a.phi;
  flange_b.tau = tau;
  flange_a.tau = -tau;
  annotation (Documentation(info="<html><p>Base class of springs. They give <code>tau</code> from <code>phi_rel</code>.</p></html>"));
end PartialCompliant;
