within ContactMultiBody.Internal.Restitution;
pure function logarithmsAtSeparation "ln(1 - d e) of each pair"
  extends Modelica.Icons.Function;
  input Real damping[:](each unit="1") "Damping factor of each pair";
  output Real t[size(damping, 1)](each unit="1") "Logarithms";
algorithm
  for i in 1:size(damping, 1) loop
    t[i] := NormalForce.Internal.logarithmAtSeparation(damping[i]);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Parameters of the contacts without events.</p>
</html>"));
end logarithmsAtSeparation;
