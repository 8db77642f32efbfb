within Modelica.Mechanics.Translational.Interfaces;
partial model PartialCompliant "Component without inertia between two flanges"
  extends PartialTwoFlanges;
  SI.Position s_rel(start=0) "Position of flange_b less that of flange_a";
  SI.Force f "Force on flange_b";
equation
  s_rel = flange_b.s - flange_a.s;
  flange_b.f = f;
  flange_a.f = -f;
  annotation (Documentation(info="<html><p>Base class of springs. They give <code>f</code> from <code>s_rel</code>.</p></html>"));
end PartialCompliant;
