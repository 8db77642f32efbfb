within Modelica.Icons;
partial package BasesPackage "Icon of a package of base classes"
  extends Modelica.Icons.Package;
  annotation (Icon(graphics={
        Ellipse(extent={{-30,20},{30,-40}}, lineColor={60,60,60}, pattern=LinePattern.Dash)}),
      Documentation(info="<html><p>The icon of packages of partial classes.</p></html>"));
end BasesPackage;
