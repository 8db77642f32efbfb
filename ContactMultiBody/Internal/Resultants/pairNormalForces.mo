within ContactMultiBody.Internal.Resultants;
pure function pairNormalForces "Normal force of each pair"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force force[:, :] "Normal force of each point";
  output Modelica.Units.SI.Force resultant[size(force, 1)] "Their sum for each pair";
algorithm
  for i in 1:size(force, 1) loop
    resultant[i] := sum(force[i, k] for k in 1:size(force, 2));
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Sums over the points of a pair.</p>
</html>"));
end pairNormalForces;
