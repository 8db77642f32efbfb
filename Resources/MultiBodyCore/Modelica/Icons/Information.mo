within Modelica.Icons;
partial class Information "Icon of a class that only documents"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-80,80},{80,-80}}, lineColor={30,80,160}, fillColor={220,235,255}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-10,20},{10,-50}}, lineColor={30,80,160}, fillColor={30,80,160}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-12,54},{12,30}}, lineColor={30,80,160}, fillColor={30,80,160}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>The letter i: the icon of classes that hold documentation alone.</p></html>"));
end Information;
