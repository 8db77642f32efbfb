within Modelica.Icons;
partial package SensorsPackage "Icon of a package of sensors"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Ellipse(extent={{-50,30},{50,-70}}, lineColor={60,60,60}, startAngle=0, endAngle=180),
        Line(points={{0,-20},{24,14}}, color={60,60,60}, arrow={Arrow.None,Arrow.Filled})}),
      Documentation(info="<html><p>The icon of packages of sensors.</p></html>"));
end SensorsPackage;
