within Modelica.Math;
function cosh "Hyperbolic cosine"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Hyperbolic cosine of u";

  external "builtin" y = cosh(u);
  annotation (Documentation(info="<html><p>The built-in function <code>cosh</code> under its qualified name.</p></html>"));
end cosh;
