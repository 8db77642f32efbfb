within ContactMultiBody.Friction.Internal;
pure function patchSum "Sum of vectors at the points of a patch, and of their moments by the radius of gyration"
  extends Modelica.Icons.Function;
  input Real share[:](each unit="1") "Share of each point";
  input Real arm[size(share, 1), 3](each unit="1") "Lever of each point about the centre of the patch, by the radius of gyration";
  input Real vector[size(share, 1), 3] "Tangential vector at each point";
  output Real resultant[6] "Sum (1:3) and moment (4:6)";
protected
  Real total[3] "Sum";
  Real moment[3] "Sum of the moments";
algorithm
  total := zeros(3);
  moment := zeros(3);
  for k in 1:size(share, 1) loop
    total := total + share[k]*vector[k, :];
    moment := moment + share[k]*cross(arm[k, :], vector[k, :]);
  end for;
  resultant := {total[1],total[2],total[3],moment[1],moment[2],moment[3]};
  annotation (Inline=false, Documentation(info="<html>
<p>Weighted by the shares; of velocities the mean velocity of the patch, of forces their resultant.</p>
</html>"));
end patchSum;
