within Modelica.Math;
function log10 "Logarithm to the base 10"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Logarithm to the base 10 of u";

  external "builtin" y = log10(u);
  annotation (Documentation(info="<html><p>The built-in function <code>log10</code> under its qualified name.</p></html>"));
end log10;
