within Modelica.Mechanics.Translational.Interfaces;
partial model PartialRigid "Rigid component between two flanges"
  SI.Position s "Position of the middle";
  parameter SI.Length L(start=0) "Distance from flange_a to flange_b";
  extends PartialTwoFlanges;
equation
  flange_a.s = s - L/2;
  flange_b.s = s + L/2;
  annotation (Documentation(info="<html><p>Base class of components that do not give way.</p></html>"));
end PartialRigid;
