within ContactMultiBody.Shapes.Internal;
pure function placement "Keys position and rotation of a descriptor, where they are needed"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position position[3] "Origin of the shape in the frame of the body";
  input Real rotation[3, 3](each unit="1") "Rotation from the body's frame to the shape's";
  output String text "Text, empty for a shape in the frame of the body";
algorithm
  text := if position*position > 0 then " position=" + numberList(position) else "";
  if rotation[1, 1] <> 1 or rotation[2, 2] <> 1 or rotation[3, 3] <> 1 then
    text := text + " rotation=" + numberList({rotation[div(i - 1, 3) + 1, mod(i - 1, 3) + 1] for i in 1:9});
  end if;
  annotation (Documentation(info="<html>
<p>A rotation with ones on its diagonal is the identity and left out.</p>
</html>"));
end placement;
