within Modelica.Blocks.Interfaces;
connector BooleanOutput = output Boolean "Boolean signal that goes out"
  annotation (defaultComponentName="y",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={200,0,160}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Boolean that goes out.</p></html>"));
