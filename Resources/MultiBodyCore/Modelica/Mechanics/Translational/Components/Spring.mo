within Modelica.Mechanics.Translational.Components;
model Spring "Linear spring"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliant;
  parameter SI.TranslationalSpringConstant c(final min=0, start=1) "Stiffness";
  parameter SI.Distance s_rel0=0 "s_rel of the relaxed spring";
equation
  f = c*(s_rel - s_rel0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-60,0},{-45,30},{-15,-30},{15,30},{45,-30},{60,0},{90,0}}, color={0,110,0}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>The force is proportional to <code>s_rel - s_rel0</code>.</p></html>"));
end Spring;
