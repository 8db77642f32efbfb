within ContactMultiBody.Internal.FreeBodies;
pure function withSurroundings "Vectors of free bodies, followed by those of immovable surroundings"
  extends Modelica.Icons.Function;
  input Real u[:, 3] "Vectors of the free bodies";
  output Real y[size(u, 1) + 1, 3] "The same, and a row of zeros";
algorithm
  for k in 1:3 loop
    for i in 1:size(u, 1) loop
      y[i, k] := u[i, k];
    end for;
    y[size(u, 1) + 1, k] := 0;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Positions, velocities or angular velocities.</p>
</html>"));
end withSurroundings;
