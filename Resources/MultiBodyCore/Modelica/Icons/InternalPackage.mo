within Modelica.Icons;
partial package InternalPackage "Icon of a package whose classes are not for direct use"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={Line(points={{-60,30},{60,-60}}, color={180,30,30}, thickness=1)}),
      Documentation(info="<html><p>The icon of packages whose classes serve this package alone.</p></html>"));
end InternalPackage;
