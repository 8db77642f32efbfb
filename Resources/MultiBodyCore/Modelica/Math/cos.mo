within Modelica.Math;
function cos "Cosine of an angle"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Angle u "Angle";
  output Real y "Cosine of u";

  external "builtin" y = cos(u);
  annotation (Documentation(info="<html><p>The built-in function <code>cos</code> under its qualified name.</p></html>"));
end cos;
