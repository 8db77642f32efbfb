within Modelica.Blocks.Interfaces;
connector BooleanInput = input Boolean "Boolean signal that comes in"
  annotation (defaultComponentName="u",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={200,0,160}, fillColor={200,0,160}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Boolean that comes in.</p></html>"));
