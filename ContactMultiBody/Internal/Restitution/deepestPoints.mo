within ContactMultiBody.Internal.Restitution;
pure function deepestPoints "Depth of each pair's deepest point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  output Modelica.Units.SI.Length deepest[size(depth, 1)] "Greatest depth of each pair, not negative";
algorithm
  for i in 1:size(depth, 1) loop
    deepest[i] := max(max(depth[i, k] for k in 1:size(depth, 2)), 0);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>0 for pairs that do not touch.</p>
</html>"));
end deepestPoints;
