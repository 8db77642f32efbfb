within ContactMultiBody.Internal.FrictionForces;
pure function frictionlessForces "Forces of all points along their normals"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  output Modelica.Units.SI.Force force[size(normalForce, 1), size(normalForce, 2), 3] "Forces on the first bodies";
algorithm
  for i in 1:size(normalForce, 1) loop
    for k in 1:size(normalForce, 2) loop
      force[i, k, :] := normalForce[i, k]*normal[i, k, :];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Forces without friction.</p>
</html>"));
end frictionlessForces;
