within Modelica.Blocks.Interfaces;
connector IntegerOutput = output Integer "Integer signal that goes out"
  annotation (defaultComponentName="y",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={220,120,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Integer that goes out.</p></html>"));
