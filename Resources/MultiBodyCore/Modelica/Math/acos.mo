within Modelica.Math;
function acos "Inverse cosine"
  extends Modelica.Icons.Function;
  input Real u "Number from -1 to 1";
  output Modelica.Units.SI.Angle y "Inverse cosine of u";

  external "builtin" y = acos(u);
  annotation (Documentation(info="<html><p>The built-in function <code>acos</code> under its qualified name.</p></html>"));
end acos;
