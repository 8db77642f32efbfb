within ContactMultiBody.Shapes;
pure function cone "Cone"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius of the base";
  input Modelica.Units.SI.Length length(min=Modelica.Constants.small) "Height";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Middle of the axis in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(radius > 0 and length > 0, "Shapes.cone: radius and length must be positive.");
  geometry := "cmb/1 cone radius=" + String(radius, significantDigits=17) + " length=" +
    String(length, significantDigits=17) + Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Solid cone along the z axis of its frame, with its base at z = -length/2 and its apex at z = +length/2.</p>
</html>"));
end cone;
