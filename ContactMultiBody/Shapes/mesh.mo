within ContactMultiBody.Shapes;
pure function mesh "Triangle mesh"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position vertices[:, 3] "Points";
  input Integer triangles[:, 3](each min=1) "Rows of vertices of each triangle, counter-clockwise seen from outside";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Origin in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(size(vertices, 1) >= 3 and size(triangles, 1) >= 1, "Shapes.mesh: a mesh needs at least one triangle.");
  geometry := "cmb/1 mesh vertices=" + Internal.numberList({vertices[div(i - 1, 3) + 1, mod(i - 1, 3) + 1] for i in 1:3*size(vertices, 1)}) +
    " triangles=" + Internal.numberList({triangles[div(i - 1, 3) + 1, mod(i - 1, 3) + 1] for i in 1:3*size(triangles, 1)}) +
    Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>A surface of triangles: a closed one with its inside, of any form, or a sheet that pushes from its front. Every edge belongs
to two triangles at most. A closed convex mesh is the hull of its vertices, as quick as that. Meshes with many triangles are better read from a file, by
<a href=\"modelica://ContactMultiBody.Shapes.meshFile\">meshFile</a>.</p>
</html>"));
end mesh;
