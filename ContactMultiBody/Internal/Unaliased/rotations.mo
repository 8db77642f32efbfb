within ContactMultiBody.Internal.Unaliased;
pure function rotations "Rotation matrices under another name"
  extends Modelica.Icons.Function;
  input Real u[:, 3, 3](each unit="1") "Matrices";
  output Real y[size(u, 1), 3, 3](each unit="1") "The same matrices";
algorithm
  for i in 1:size(u, 1) loop
    y[i, :, :] := u[i, :, :];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>See the package.</p>
</html>"));
end rotations;
