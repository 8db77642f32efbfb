within Modelica.Mechanics.Rotational.Components;
model Spring "Linear spring"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialCompliant;
  parameter SI.RotationalSpringConstant c(final min=0, start=1.0e5) "Stiffness";
  parameter SI.Angle phi_rel0=0 "phi_rel of the relaxed spring";
equation
  tau = c*(phi_rel - phi_rel0);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-90,0},{-60,0},{-45,30},{-15,-30},{15,30},{45,-30},{60,0},{90,0}}, color={0,110,0}, thickness=1),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>The torque is proportional to <code>phi_rel - phi_rel0</code>.</p></html>"));
end Spring;
