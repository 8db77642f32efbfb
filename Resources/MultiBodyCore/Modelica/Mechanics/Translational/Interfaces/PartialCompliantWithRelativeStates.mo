within Modelica.Mechanics.Translational.Interfaces;
partial model PartialCompliantWithRelativeStates "Component without inertia between two flanges whose relative motion can be states"
  parameter StateSelect stateSelect=StateSelect.prefer "Priority of s_rel and v_rel as states" annotation (Dialog(tab="Advanced"));
  parameter SI.Distance s_nominal=1e-4 "Nominal value of s_rel" annotation (Dialog(tab="Advanced"));
  SI.Position s_rel(start=0, stateSelect=stateSelect, nominal=s_nominal) "Position of flange_b less that of flange_a";
  SI.Velocity v_rel(start=0, stateSelect=stateSelect) "Derivative of s_rel";
  SI.Force f "Force on flange_b";
  extends PartialTwoFlanges;
equation
  s_rel = flange_b.s - flange_a.s;
  v_rel = der(s_rel);
  flange_b.f = f;
  flange_a.f = -f;
  annotation (Documentation(info="<html>
<p>Base class of dampers. They give <code>f</code> from <code>s_rel</code> and <code>v_rel</code>.</p></html>"));
end PartialCompliantWithRelativeStates;
