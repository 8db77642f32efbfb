within ContactMultiBody.Internal.FreeBodies;
pure function withSurroundingsFrame "Rotations of free bodies, followed by that of immovable surroundings"
  extends Modelica.Icons.Function;
  input Real T[:, 3, 3](each unit="1") "Rotations of the free bodies";
  output Real y[size(T, 1) + 1, 3, 3](each unit="1") "The same, and the identity";
algorithm
  for j in 1:3 loop
    for k in 1:3 loop
      for i in 1:size(T, 1) loop
        y[i, j, k] := T[i, j, k];
      end for;
      y[size(T, 1) + 1, j, k] := if j == k then 1 else 0;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Surroundings are described in world axes.</p>
</html>"));
end withSurroundingsFrame;
