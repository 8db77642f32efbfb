within ContactMultiBody.Internal.FrictionForces;
pure function regularisedForces "Forces of all points with regularised friction"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Modelica.Units.SI.Force normalForce[size(depth, 1), size(depth, 2)] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  input Modelica.Units.SI.Velocity velocity[size(normalForce, 1), size(normalForce, 2), 3] "Relative velocities";
  input Modelica.Units.SI.Velocity speed[size(normalForce, 1), size(normalForce, 2)] "Approach speeds";
  input Real mu[size(normalForce, 1)](each unit="1") "Coefficient of friction of each pair";
  input Modelica.Units.SI.Velocity regularisationSpeed "Speed over which the force changes its direction";
  output Modelica.Units.SI.Force force[size(normalForce, 1), size(normalForce, 2), 3] "Forces on the first bodies";
algorithm
  for i in 1:size(normalForce, 1) loop
    for k in 1:size(normalForce, 2) loop
      force[i, k, :] := if depth[i, k] > 0 then normalForce[i, k]*normal[i, k, :] + Friction.regularised(
        normalForce[i, k],
        velocity[i, k, :] + speed[i, k]*normal[i, k, :],
        mu[i],
        regularisationSpeed) else zeros(3);
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Adds <a href=\"modelica://ContactMultiBody.Friction.regularised\">Friction.regularised</a> at each point.</p>
</html>"));
end regularisedForces;
