within Modelica;
package Math "Mathematical functions"
  extends Modelica.Icons.FunctionsPackage;
  annotation (Documentation(info="<html>
<p>The elementary functions under their qualified names, and functions of <a href=\"modelica://Modelica.Math.Vectors\">vectors</a>.</p>
</html>"));
end Math;
