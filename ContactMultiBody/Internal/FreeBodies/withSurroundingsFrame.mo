within ContactMultiBody.Internal.FreeBodies;
pure function withSurroundingsFrame "Rotations of free bodies, followed by that of immovable surroundings"
  extends Modelica.Icons.Function;
  input Real T[:, 3, 3](each unit="1") "Rotations of the free bodies";
  output Real y[size(T, 1) + 1, 3, 3](each unit="1") "The same, and the identity";
algorithm
  for i in 1:size(T, 1) loop
    y[i, :, :] := T[i, :, :];
  end for;
  y[size(T, 1) + 1, :, :] := {{1,0,0},{0,1,0},{0,0,1}};
  annotation (Inline=false, Documentation(info="<html>
<p>Surroundings are described in world axes.</p>
</html>"));
end withSurroundingsFrame;
