within ContactMultiBody.Shapes;
pure function capsule "Capsule: all points within a radius of a segment"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Radius radius(min=Modelica.Constants.small) "Radius";
  input Modelica.Units.SI.Length length(min=0) "Length of the segment between the centres of the round ends";
  input Modelica.Units.SI.Position position[3]={0,0,0} "Centre in the frame of the body";
  input Real rotation[3, 3](each unit="1")=identity(3) "Rotation from the body's frame to the shape's";
  output String geometry "Descriptor";
algorithm
  assert(radius > 0, "Shapes.capsule: radius must be positive.");
  assert(length >= 0, "Shapes.capsule: length must not be negative.");
  geometry := "cmb/1 capsule radius=" + String(radius, significantDigits=17) + " length=" +
    String(length, significantDigits=17) + Internal.placement(position, rotation);
  annotation (Documentation(info="<html>
<p>Cylinder with hemispheres on both ends, along the z axis of its frame and centred there. The whole is length + 2 radius long.</p>
</html>"));
end capsule;
