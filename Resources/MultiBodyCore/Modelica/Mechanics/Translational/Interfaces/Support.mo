within Modelica.Mechanics.Translational.Interfaces;
connector Support "Housing of a rod"
  extends Flange;
  annotation (defaultComponentName="support",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,110,0}, fillColor={220,220,220}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-70,70},{70,-70}}, lineColor={0,110,0}, fillColor={0,110,0}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>A flange of the housing, which takes the reaction.</p></html>"));
end Support;
