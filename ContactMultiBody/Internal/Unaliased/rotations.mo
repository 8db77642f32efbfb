within ContactMultiBody.Internal.Unaliased;
pure function rotations "Rotation matrices under another name"
  extends Modelica.Icons.Function;
  input Real u[:, 3, 3](each unit="1") "Matrices";
  output Real y[size(u, 1), 3, 3](each unit="1") "The same matrices";
algorithm
  for i in 1:size(u, 1) loop
    for j in 1:3 loop
      for k in 1:3 loop
        y[i, j, k] := u[i, j, k];
      end for;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>See the package.</p>
</html>"));
end rotations;
