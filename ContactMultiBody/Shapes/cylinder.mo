within ContactMultiBody.Shapes;
pure function cylinder "Cylinder"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius";
  input Modelica.Units.SI.Length length(min=Modelica.Constants.small) "Length";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Centre in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(radius > 0 and length > 0, "Shapes.cylinder: radius and length must be positive.");
  geometry := "cmb/1 cylinder radius=" + String(radius, significantDigits=17) + " length=" +
    String(length, significantDigits=17) + Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Solid cylinder along the z axis of its frame, centred there.</p>
</html>"));
end cylinder;
