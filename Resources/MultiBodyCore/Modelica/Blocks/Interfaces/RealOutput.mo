within Modelica.Blocks.Interfaces;
connector RealOutput = output Real "Real signal that goes out"
  annotation (defaultComponentName="y",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,160}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Real that goes out.</p></html>"));
