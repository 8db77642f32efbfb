within Modelica.Mechanics.Rotational.Components;
model Inertia "Body that turns"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialTwoFlanges;
  parameter SI.Inertia J(min=0, start=1) "Moment of inertia";
  parameter StateSelect stateSelect=StateSelect.default "Priority of phi and w as states" annotation (Dialog(tab="Advanced"));
  SI.Angle phi(stateSelect=stateSelect) "Angle";
  SI.AngularVelocity w(stateSelect=stateSelect) "Derivative of phi";
  SI.AngularAcceleration a "Derivative of w";
equation
  phi = flange_a.phi;
  phi = flange_b.phi;
  w = der(phi);
  a = der(w);
  J*a = flange_a.tau + flange_b.tau;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{100,0}}, color={70,70,70}, thickness=2),
        Rectangle(extent={{-70,50},{70,-50}}, lineColor={70,70,70}, fillColor={190,190,190}, fillPattern=FillPattern.HorizontalCylinder),
        Text(extent={{-150,110},{150,75}}, textColor={70,70,70}, textString="%name")}),
    Documentation(info="<html><p>A rigid shaft with the moment of inertia <code>J</code>.</p></html>"));
end Inertia;
