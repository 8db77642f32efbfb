within Modelica.Math;
function exp "Exponential function"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Exponential function of u";

  external "builtin" y = exp(u);
  annotation (Documentation(info="<html><p>The built-in function <code>exp</code> under its qualified name.</p></html>"));
end exp;
