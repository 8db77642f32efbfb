within ContactMultiBody.Shapes;
pure function meshFile "Triangle mesh from an STL, OBJ or PLY file"
  extends Modelica.Icons.Function;
  input String fileName "File, as Modelica.Utilities.Files.loadResource gives it" annotation (Dialog(
      loadSelector(filter="Meshes (*.stl;*.obj;*.ply)", caption="Open mesh")));
  input Real scale(min=Modelica.Constants.small, unit="1")=1 "Metres in the file's unit of length, 1e-3 for millimetres";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Origin in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(scale > 0, "Shapes.meshFile: the scale must be positive.");
  geometry := "cmb/1 mesh file=\"" + fileName + "\" scale=" + String(scale, significantDigits=17) +
    Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Write <code>meshFile(Modelica.Utilities.Files.loadResource(\"modelica://MyLibrary/Resources/part.stl\"))</code>. The file is read when
the simulation starts. The FMU builder of this project reads it at translation and puts the triangles into the FMU, which then
needs no file; it takes <code>modelica://</code> names as they are.</p>
</html>"));
end meshFile;
