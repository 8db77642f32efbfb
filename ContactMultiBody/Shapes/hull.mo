within ContactMultiBody.Shapes;
pure function hull "Convex hull of points"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position vertices[:, 3] "Points; those inside the hull do no harm";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Origin in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(size(vertices, 1) >= 4, "Shapes.hull: a solid needs at least four points.");
  geometry := "cmb/1 hull vertices=" + Internal.numberList({vertices[div(i - 1, 3) + 1, mod(i - 1, 3) + 1] for i in 1:3*size(vertices, 1)}) +
    Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Convex solid spanned by points. For shapes that are not convex, join the hulls of convex pieces by <a href=\"modelica://ContactMultiBody.Shapes.compound\">compound</a>. Long lists of points are better given as one literal string, which every tool reads fast.</p>
</html>"));
end hull;
