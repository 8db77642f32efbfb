within Modelica.Mechanics.Translational.Components;
model Mass "Body that slides"
  parameter SI.Mass m(min=0, start=1) "Mass";
  parameter StateSelect stateSelect=StateSelect.default "Priority of s and v as states" annotation (Dialog(tab="Advanced"));
  extends Modelica.Mechanics.Translational.Interfaces.PartialRigid(L=0, s(start=0, stateSelect=stateSelect));
  SI.Velocity v(start=0, stateSelect=stateSelect) "Derivative of s";
  SI.Acceleration a(start=0) "Derivative of v";
equation
  v = der(s);
  a = der(v);
  m*a = flange_a.f + flange_b.f;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={70,70,70}, thickness=2),
        Rectangle(extent={{-70,50},{70,-50}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A rigid rod with the mass <code>m</code>.</p></html>"));
end Mass;
