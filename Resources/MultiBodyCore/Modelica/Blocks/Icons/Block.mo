within Modelica.Blocks.Icons;
partial block Block "Icon of a block"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,160}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,145},{150,110}}, textColor={0,0,160}, textString="%name")}),
      Documentation(info="<html><p>A square with the name above it.</p></html>"));
end Block;
