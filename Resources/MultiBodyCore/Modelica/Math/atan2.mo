within Modelica.Math;
function atan2 "Angle of the point (u2, u1), in all four quadrants"
  extends Modelica.Icons.Function;
  input Real u1 "Second coordinate (proportional to the sine)";
  input Real u2 "First coordinate (proportional to the cosine)";
  output Modelica.Units.SI.Angle y "Angle from the first axis, between -pi and pi";

  external "builtin" y = atan2(u1, u2);
  annotation (Documentation(info="<html><p>The built-in function <code>atan2</code> under its qualified name.</p></html>"));
end atan2;
