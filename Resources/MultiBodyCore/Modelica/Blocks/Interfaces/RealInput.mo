within Modelica.Blocks.Interfaces;
connector RealInput = input Real "Real signal that comes in"
  annotation (defaultComponentName="u",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,100},{100,0},{-100,-100},{-100,100}}, lineColor={0,0,160}, fillColor={0,0,160}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>Signal of type Real that comes in.</p></html>"));
