within ContactMultiBody.Shapes;
pure function ellipsoid "Ellipsoid"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length size[3](each min=Modelica.Constants.small) "Full lengths of the axes";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Centre in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(size[1] > 0 and size[2] > 0 and size[3] > 0, "Shapes.ellipsoid: all lengths must be positive.");
  geometry := "cmb/1 ellipsoid size=" + Internal.numberList(size) + Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Solid ellipsoid, centred in its frame.</p>
</html>"));
end ellipsoid;
