within Modelica.Icons;
partial package FunctionsPackage "Icon of a package of functions"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Text(extent={{-60,40},{60,-60}}, textColor={160,80,40}, textString="f")}),
      Documentation(info="<html><p>The icon of packages of functions.</p></html>"));
end FunctionsPackage;
