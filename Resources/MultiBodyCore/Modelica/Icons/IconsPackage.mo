within Modelica.Icons;
partial package IconsPackage "Icon of a package of icons"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Rectangle(extent={{-40,20},{40,-50}}, lineColor={160,80,40}, pattern=LinePattern.Dash)}),
      Documentation(info="<html><p>The icon of packages of icons.</p></html>"));
end IconsPackage;
