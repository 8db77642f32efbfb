within ContactMultiBody.PureModelica.Geometry;
pure function closestOfSegments "Closest points of two segments"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position a[3] "Middle of the first segment";
  input Real u[3](each unit="1") "Unit direction of the first segment";
  input Modelica.Units.SI.Length lengthA "Length of the first segment";
  input Modelica.Units.SI.Position b[3] "Middle of the second segment";
  input Real v[3](each unit="1") "Unit direction of the second segment";
  input Modelica.Units.SI.Length lengthB "Length of the second segment";
  output Modelica.Units.SI.Position p[3] "Point of the first segment";
  output Modelica.Units.SI.Position q[3] "Point of the second segment";
protected
  Real c(unit="1") "Cosine of the angle between the directions";
  Modelica.Units.SI.Position s "Parameter on the first segment";
  Modelica.Units.SI.Position t "Parameter on the second segment";
algorithm
  c := u*v;
  s := min(max(((b - a)*u - c*((b - a)*v))/max(1 - c^2, 1e-12), -lengthA/2), lengthA/2);
  t := min(max((a + s*u - b)*v, -lengthB/2), lengthB/2);
  s := min(max((b + t*v - a)*u, -lengthA/2), lengthA/2);
  p := a + s*u;
  q := b + t*v;
  annotation (Inline=false, Documentation(info="<html>
<p>
Solves for the closest points of the two lines, limits the first, then each to the closest of the other. Parallel segments touch along a length; one point of it is returned.
Source: C. Ericson: Real-Time Collision Detection, Morgan Kaufmann 2005, section 5.1.9.
</p>
</html>"));
end closestOfSegments;
