within Modelica.Math;
function sin "Sine of an angle"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Angle u "Angle";
  output Real y "Sine of u";

  external "builtin" y = sin(u);
  annotation (Documentation(info="<html><p>The built-in function <code>sin</code> under its qualified name.</p></html>"));
end sin;
