within Modelica.Math;
function sinh "Hyperbolic sine"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Real y "Hyperbolic sine of u";

  external "builtin" y = sinh(u);
  annotation (Documentation(info="<html><p>The built-in function <code>sinh</code> under its qualified name.</p></html>"));
end sinh;
