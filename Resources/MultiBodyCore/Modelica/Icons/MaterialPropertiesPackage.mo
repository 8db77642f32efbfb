within Modelica.Icons;
partial package MaterialPropertiesPackage "Icon of a package of material data"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Ellipse(extent={{-40,20},{40,-60}}, lineColor={60,60,60}, fillColor={180,180,180}, fillPattern=FillPattern.Sphere)}),
      Documentation(info="<html><p>The icon of packages of material data.</p></html>"));
end MaterialPropertiesPackage;
