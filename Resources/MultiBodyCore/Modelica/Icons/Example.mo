within Modelica.Icons;
partial model Example "Icon of a model that can be simulated as it is"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-90,90},{90,-90}}, lineColor={40,120,40}, fillColor={240,250,240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-30,50},{60,0},{-30,-50},{-30,50}}, lineColor={40,120,40}, fillColor={40,120,40}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>A start button: the icon of models that are complete and can be simulated.</p></html>"));
end Example;
