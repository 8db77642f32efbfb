within ContactMultiBody.Shapes;
pure function compound "Several shapes as one"
  extends Modelica.Icons.Function;
  input String shapes[:] "Descriptors of the shapes";
  output String geometry "Descriptor";
algorithm
  assert(size(shapes, 1) > 0, "Shapes.compound: give at least one shape.");
  geometry := shapes[1];
  for i in 2:size(shapes, 1) loop
    geometry := geometry + ";" + shapes[i];
  end for;
  annotation (Documentation(info="<html>
<p>The shapes keep their places in the frame of the body. They may overlap.</p>
</html>"));
end compound;
