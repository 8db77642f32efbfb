within Modelica.Mechanics.Rotational.Interfaces;
partial model PartialCompliantWithRelativeStates "Component without inertia between two flanges whose relative motion can be states"
  SI.Angle phi_rel(start=0, stateSelect=stateSelect, nominal=if phi_nominal >= Modelica.Constants.eps then phi_nominal else 1)
    "Angle of flange_b less that of flange_a";
  SI.AngularVelocity w_rel(start=0, stateSelect=stateSelect) "Derivative of phi_rel";
  SI.AngularAcceleration a_rel(start=0) "Derivative of w_rel";
  SI.Torque tau "Torque on flange_b";
  Flange_a flange_a "First flange" annotation (Placement(transformation(extent={{-110,-10},{-90,10}})));
  Flange_b flange_b "Second flange" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  parameter SI.Angle phi_nominal(displayUnit="rad", min=0.0) = 1e-4 "Nominal value of phi_rel" annotation (Dialog(tab="Advanced"));
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of phi_rel and w_rel as states" annotation (Dialog(tab="Advanced"));
equation
  phi_rel = flange_b.phi - flange_a.phi;
  w_rel = der(phi_rel);
  a_rel = der(w_rel);
  flange_b.tau = tau;
  flange_a.tau = -tau;
  annotation (Documentation(info="<html>
<p>Base class of dampers. They give <code>tau</code> from <code>phi_rel</code> and <code>w_rel</code>.</p></html>"));
end PartialCompliantWithRelativeStates;
