within ContactMultiBody.Internal.Resultants;
pure function bodyForces "Resultant contact force on each body"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force force[:, :, 3] "Forces of the points on the first bodies";
  input Integer pairs[size(force, 1), 2] "Bodies of each pair";
  input Integer n "Number of bodies";
  output Modelica.Units.SI.Force resultant[n, 3] "Forces on the bodies, in world axes";
algorithm
  resultant := zeros(n, 3);
  for i in 1:size(force, 1) loop
    for k in 1:size(force, 2) loop
      resultant[pairs[i, 1], :] := resultant[pairs[i, 1], :] + force[i, k, :];
      resultant[pairs[i, 2], :] := resultant[pairs[i, 2], :] - force[i, k, :];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Actio and reactio.</p>
</html>"));
end bodyForces;
