within Modelica.Math;
function tanh "Hyperbolic tangent"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Hyperbolic tangent of u";

  external "builtin" y = tanh(u);
  annotation (Documentation(info="<html><p>The built-in function <code>tanh</code> under its qualified name.</p></html>"));
end tanh;
