within Modelica.Icons;
partial package VariantsPackage "Icon of a package of variants"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Ellipse(extent={{-50,10},{-10,-30}}, lineColor={60,60,60}),
        Ellipse(extent={{10,10},{50,-30}}, lineColor={60,60,60}, fillColor={120,120,120}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>The icon of packages of variants of one thing.</p></html>"));
end VariantsPackage;
