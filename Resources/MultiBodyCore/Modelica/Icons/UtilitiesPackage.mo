within Modelica.Icons;
partial package UtilitiesPackage "Icon of a package of helper classes"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Line(points={{-50,-50},{40,30}}, color={60,60,60}, thickness=1)}),
      Documentation(info="<html><p>The icon of packages of helper classes.</p></html>"));
end UtilitiesPackage;
