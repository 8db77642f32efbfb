within ContactMultiBody.Internal.Unaliased;
pure function tensors "Inertia tensors under another name"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Inertia u[:, 3, 3] "Tensors";
  output Modelica.Units.SI.Inertia y[size(u, 1), 3, 3] "The same tensors";
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
end tensors;
