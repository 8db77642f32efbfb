within Modelica.Mechanics.Translational.Components;
model Rod "Rod without mass"
  extends Modelica.Mechanics.Translational.Interfaces.PartialRigid;
equation
  0 = flange_a.f + flange_b.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={70,70,70}, thickness=2),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A rigid rod of the length <code>L</code>.</p></html>"));
end Rod;
