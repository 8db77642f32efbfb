within Modelica.Blocks.Interfaces;
connector IntegerInput = input Integer "Integer signal that comes in"
  annotation (defaultComponentName="u",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={220,120,0}, fillColor={220,120,0}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Integer that comes in.</p></html>"));
