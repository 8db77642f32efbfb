within ContactMultiBody.Shapes;
pure function heightField "Ground given by heights over a grid"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length lengths[2](each min=Modelica.Constants.small) "Full lengths along x and y";
  input Modelica.Units.SI.Position height[:, :] "Heights along z; a row for each y, from -lengths[2]/2 up, a column for each x";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Middle of the grid in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(lengths[1] > 0 and lengths[2] > 0, "Shapes.heightField: both lengths must be positive.");
  assert(size(height, 1) >= 2 and size(height, 2) >= 2, "Shapes.heightField: a grid has at least two rows and two columns.");
  geometry := "cmb/1 heightfield size=" + Internal.numberList(lengths) + " grid=" + String(size(height, 2)) + "," + String(size(height, 1)) +
    " heights=" + Internal.numberList({height[div(i - 1, size(height, 2)) + 1, mod(i - 1, size(height, 2)) + 1] for i in 1:size(height, 1)*size(height, 2)}) +
    Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Terrain: between the heights lie two triangles a cell. It has no sides and no underside; bodies are pushed towards +z of
the shape. Bodies that have sunk below it deeper than half of their size pass through.</p>
</html>"));
end heightField;
