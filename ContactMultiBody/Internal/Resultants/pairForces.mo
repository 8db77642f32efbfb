within ContactMultiBody.Internal.Resultants;
pure function pairForces "Force on the first body of each pair"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force force[:, :, 3] "Forces of the points on the first bodies";
  output Modelica.Units.SI.Force resultant[size(force, 1), 3] "Their sum for each pair, in world axes";
algorithm
  for i in 1:size(force, 1) loop
    for c in 1:3 loop
      resultant[i, c] := sum(force[i, k, c] for k in 1:size(force, 2));
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Sums over the points of a pair.</p>
</html>"));
end pairForces;
