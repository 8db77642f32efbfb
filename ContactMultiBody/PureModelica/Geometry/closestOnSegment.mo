within ContactMultiBody.PureModelica.Geometry;
pure function closestOnSegment "Point of a segment closest to a point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position p[3] "Point";
  input Modelica.Units.SI.Position centre[3] "Middle of the segment";
  input Real axis[3](each unit="1") "Unit direction of the segment";
  input Modelica.Units.SI.Length length "Length of the segment";
  output Modelica.Units.SI.Position q[3] "Closest point";
algorithm
  q := centre + min(max((p - centre)*axis, -length/2), length/2)*axis;
  annotation (Inline=false, Documentation(info="<html>
<p>Projects the point onto the line and limits it to the segment.</p>
</html>"));
end closestOnSegment;
