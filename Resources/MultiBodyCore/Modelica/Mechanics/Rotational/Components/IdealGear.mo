within Modelica.Mechanics.Rotational.Components;
model IdealGear "Gear without loss and inertia"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialElementaryTwoFlangesAndSupport2;
  parameter Real ratio(start=1) "Angle of flange_a by the angle of flange_b";
  SI.Angle phi_a "Angle of flange_a less that of the support";
  SI.Angle phi_b "Angle of flange_b less that of the support";
equation
  phi_a = flange_a.phi - phi_support;
  phi_b = flange_b.phi - phi_support;
  phi_a = ratio*phi_b;
  0 = ratio*flange_a.tau + flange_b.tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={70,70,70}, thickness=2),
        Rectangle(extent={{-40,20},{-20,-60}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Rectangle(extent={{20,70},{40,-40}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html>
<p>The flanges turn in the ratio <code>ratio</code>, negative for opposite directions; no power is lost.</p></html>"));
end IdealGear;
