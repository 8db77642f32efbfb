within ContactMultiBody.Internal.NormalForces;
pure function normalForces "Normal forces of all points"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Real weight[size(depth, 1), size(depth, 2)](each unit="1") "Weights of the points";
  input Modelica.Units.SI.Velocity speed[size(depth, 1), size(depth, 2)] "Approach speeds";
  input Real stiffness[size(depth, 1)] "Stiffness of each pair";
  input Real exponent(unit="1") "Exponent of the depth";
  input Real rate[size(depth, 1)](each unit="s/m") "Damping factor by impact speed of each pair";
  output Modelica.Units.SI.Force force[size(depth, 1), size(depth, 2)] "Normal forces";
algorithm
  for i in 1:size(depth, 1) loop
    for k in 1:size(depth, 2) loop
      force[i, k] := if depth[i, k] > 0 then weight[i, k]*NormalForce.normalForce(depth[i, k], speed[i, k], stiffness[i],
        exponent, rate[i]) else 0;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.NormalForce.normalForce\">NormalForce.normalForce</a> to each point.</p>
</html>"));
end normalForces;
