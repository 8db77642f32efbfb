within ContactMultiBody.Internal.FreeBodies;
pure function worldVectors "Vectors of bodies' axes in world axes"
  extends Modelica.Icons.Function;
  input Real T[:, 3, 3](each unit="1") "Rotation from world to each body's frame";
  input Real v[size(T, 1), 3] "Vector in each body's axes";
  output Real v_0[size(T, 1), 3] "The same vectors in world axes";
algorithm
  for i in 1:size(T, 1) loop
    for k in 1:3 loop
      v_0[i, k] := T[i, :, k]*v[i, :];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies the transposed rotation of each body.</p>
</html>"));
end worldVectors;
