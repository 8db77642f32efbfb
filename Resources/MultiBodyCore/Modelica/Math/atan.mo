within Modelica.Math;
function atan "Inverse tangent"
  extends Modelica.Icons.Function;
  input Real u "Number";
  output Modelica.Units.SI.Angle y "Inverse tangent of u";

  external "builtin" y = atan(u);
  annotation (Documentation(info="<html><p>The built-in function <code>atan</code> under its qualified name.</p></html>"));
end atan;
