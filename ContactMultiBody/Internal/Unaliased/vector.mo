within ContactMultiBody.Internal.Unaliased;
pure function vector "A vector under another name"
  extends Modelica.Icons.Function;
  input Real u[:] "Vector";
  output Real y[size(u, 1)] "The same vector";
algorithm
  for i in 1:size(u, 1) loop
    y[i] := u[i];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>See the package.</p>
</html>"));
end vector;
