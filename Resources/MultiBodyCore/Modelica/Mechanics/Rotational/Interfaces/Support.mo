within Modelica.Mechanics.Rotational.Interfaces;
connector Support "Housing of a shaft"
  extends Flange;
  annotation (defaultComponentName="support",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={80,80,80}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-80,80},{80,-80}}, lineColor={80,80,80}, fillColor={140,140,140}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A flange of the housing, which takes the reaction.</p></html>"));
end Support;
