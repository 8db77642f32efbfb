within ContactMultiBody.Internal.FreeBodies;
pure function withSurroundings "Vectors of free bodies, followed by those of immovable surroundings"
  extends Modelica.Icons.Function;
  input Real u[:, 3] "Vectors of the free bodies";
  output Real y[size(u, 1) + 1, 3] "The same, and a row of zeros";
algorithm
  y := zeros(size(u, 1) + 1, 3);
  for i in 1:size(u, 1) loop
    y[i, :] := u[i, :];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Positions, velocities or angular velocities.</p>
</html>"));
end withSurroundings;
