within Modelica.Icons;
partial package ExamplesPackage "Icon of a package of examples"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Polygon(points={{-30,30},{50,-10},{-30,-50},{-30,30}}, lineColor={40,120,40}, fillColor={40,120,40}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>The icon of packages of examples.</p></html>"));
end ExamplesPackage;
