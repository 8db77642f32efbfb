within Modelica.Icons;
partial package RecordsPackage "Icon of a package of records"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Line(points={{-50,0},{50,0}}, color={60,60,60}), Line(points={{-50,-30},{50,-30}}, color={60,60,60})}),
      Documentation(info="<html><p>The icon of packages of records.</p></html>"));
end RecordsPackage;
