within Modelica.Icons;
partial package InterfacesPackage "Icon of a package of connectors and partial classes"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Rectangle(extent={{-50,10},{-10,-30}}, lineColor={60,60,60}, fillColor={120,120,120}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{10,10},{50,-30}}, lineColor={60,60,60}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Line(points={{-10,-10},{10,-10}}, color={60,60,60})}),
      Documentation(info="<html><p>The icon of packages of connectors and partial classes.</p></html>"));
end InterfacesPackage;
