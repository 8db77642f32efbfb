within Modelica.Icons;
partial package Package "Icon of a package"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-90,60},{90,-80}}, lineColor={60,60,60}, fillColor={235,235,235}, fillPattern=FillPattern.Solid),
        Polygon(points={{-90,60},{-70,84},{-10,84},{10,60},{-90,60}}, lineColor={60,60,60}, fillColor={215,215,215}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>A folder: the icon of packages.</p></html>"));
end Package;
