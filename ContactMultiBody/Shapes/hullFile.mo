within ContactMultiBody.Shapes;
pure function hullFile "Convex hull of the points of an STL, OBJ or PLY file"
  extends Modelica.Icons.Function;
  input String fileName "File, as Modelica.Utilities.Files.loadResource gives it" annotation (Dialog(
      loadSelector(filter="Meshes (*.stl;*.obj;*.ply)", caption="Open mesh")));
  input Real scale(min=Modelica.Constants.small, unit="1")=1 "Metres in the file's unit of length, 1e-3 for millimetres";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Origin in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(scale > 0, "Shapes.hullFile: the scale must be positive.");
  geometry := "cmb/1 hull file=\"" + fileName + "\" scale=" + String(scale, significantDigits=17) +
    Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Faster than a mesh that is not convex, and right for bodies that are; a closed convex mesh is its hull in either way. The file is found as by
<a href=\"modelica://ContactMultiBody.Shapes.meshFile\">meshFile</a>.</p>
</html>"));
end hullFile;
