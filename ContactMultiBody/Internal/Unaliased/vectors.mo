within ContactMultiBody.Internal.Unaliased;
pure function vectors "Vectors under another name"
  extends Modelica.Icons.Function;
  input Real u[:, 3] "Vectors";
  output Real y[size(u, 1), 3] "The same vectors";
algorithm
  for i in 1:size(u, 1) loop
    for k in 1:3 loop
      y[i, k] := u[i, k];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>See the package.</p>
</html>"));
end vectors;
