within Modelica;
package Utilities "Functions for files"
  extends Modelica.Icons.UtilitiesPackage;
  annotation (Documentation(info="<html>
<p>Names of <a href=\"modelica://Modelica.Utilities.Files\">files</a>.</p>
</html>"));
end Utilities;
