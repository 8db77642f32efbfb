within Modelica.Math;
function tan "Tangent of an angle"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Angle u "Angle";
  output Real y "Tangent of u";

  external "builtin" y = tan(u);
  annotation (Documentation(info="<html><p>The built-in function <code>tan</code> under its qualified name.</p></html>"));
end tan;
