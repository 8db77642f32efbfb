within Modelica.Math;
function asin "Inverse sine"
  extends Modelica.Icons.Function;
  input Real u "Number from -1 to 1";
  output Modelica.Units.SI.Angle y "Inverse sine of u";

  external "builtin" y = asin(u);
  annotation (Documentation(info="<html><p>The built-in function <code>asin</code> under its qualified name.</p></html>"));
end asin;
