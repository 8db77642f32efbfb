within Modelica.Icons;
partial package SourcesPackage "Icon of a package of sources"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Ellipse(extent={{-50,20},{10,-40}}, lineColor={60,60,60}),
        Line(points={{10,-10},{60,-10}}, color={60,60,60}, arrow={Arrow.None,Arrow.Filled})}),
      Documentation(info="<html><p>The icon of packages of sources.</p></html>"));
end SourcesPackage;
