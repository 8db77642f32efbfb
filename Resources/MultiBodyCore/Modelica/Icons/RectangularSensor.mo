within Modelica.Icons;
partial class RectangularSensor "Icon of a rectangular measuring instrument"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-70,40},{70,-60}}, lineColor={60,60,60}, fillColor={250,250,250}, fillPattern=FillPattern.Solid),
        Line(points={{-60,-50},{60,-50}}, color={60,60,60}),
        Polygon(points={{0,-46},{-8,-16},{8,-16},{0,-46}}, lineColor={60,60,60}, fillColor={60,60,60}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>The icon of sensors: a scale.</p></html>"));
end RectangularSensor;
