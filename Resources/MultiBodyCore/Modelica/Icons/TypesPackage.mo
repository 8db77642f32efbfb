within Modelica.Icons;
partial package TypesPackage "Icon of a package of types"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Text(extent={{-60,40},{60,-60}}, textColor={60,60,60}, textString="T")}),
      Documentation(info="<html><p>The icon of packages of types.</p></html>"));
end TypesPackage;
