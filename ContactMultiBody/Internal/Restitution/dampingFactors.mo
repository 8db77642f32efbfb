within ContactMultiBody.Internal.Restitution;
pure function dampingFactors "Damping factor of each pair"
  extends Modelica.Icons.Function;
  input Types.NormalLaw law "Law of the normal force";
  input Real restitution[:](each min=0, each max=1, each unit="1") "Coefficient of restitution of each pair";
  output Real damping[size(restitution, 1)](each unit="1") "Damping factor of each pair";
algorithm
  for i in 1:size(restitution, 1) loop
    damping[i] := NormalForce.dampingFactor(law, restitution[i]);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.NormalForce.dampingFactor\">NormalForce.dampingFactor</a> to each pair.</p>
</html>"));
end dampingFactors;
