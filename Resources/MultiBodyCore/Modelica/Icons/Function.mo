within Modelica.Icons;
partial function Function "Icon of a function"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-90,90},{90,-90}}, lineColor={160,80,40}, fillColor={255,250,240}, fillPattern=FillPattern.Solid),
        Text(extent={{-60,60},{60,-60}}, textColor={160,80,40}, textString="f")}),
      Documentation(info="<html><p>The icon of functions.</p></html>"));
end Function;
