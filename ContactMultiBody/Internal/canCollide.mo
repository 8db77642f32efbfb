within ContactMultiBody.Internal;
pure function canCollide "= true, if both bodies of a pair have a geometry"
  extends Modelica.Icons.Function;
  input String geometry[:] "Descriptor of each body's geometry";
  input Integer pairs[:, 2] "Bodies of each pair";
  output Boolean result "= true, if something can touch";
algorithm
  result := false;
  for i in 1:size(pairs, 1) loop
    result := result or geometry[pairs[i, 1]] <> "" and geometry[pairs[i, 2]] <> "";
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>For a message where geometries were forgotten: nothing would ever touch.</p>
</html>"));
end canCollide;
