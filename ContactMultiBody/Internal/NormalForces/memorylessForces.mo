within ContactMultiBody.Internal.NormalForces;
pure function memorylessForces "Normal forces of all points that deliver a restitution without events"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Real weight[size(depth, 1), size(depth, 2)](each unit="1") "Weights of the points";
  input Modelica.Units.SI.Velocity speed[size(depth, 1), size(depth, 2)] "Approach speeds";
  input Real stiffness[size(depth, 1)] "Stiffness of each pair";
  input Real exponent(unit="1") "Exponent of the depth";
  input Modelica.Units.SI.Acceleration springDeceleration[size(depth, 1), size(depth, 2)] "Deceleration of each point by the springs";
  input Real damping[size(depth, 1)](each unit="1") "Damping factor of each pair";
  input Real logarithmAtSeparation[size(depth, 1)](each unit="1") "ln(1 - d e) of each pair";
  output Modelica.Units.SI.Force force[size(depth, 1), size(depth, 2)] "Normal forces";
algorithm
  for i in 1:size(depth, 1) loop
    for k in 1:size(depth, 2) loop
      force[i, k] := if depth[i, k] > 0 then weight[i, k]*NormalForce.memorylessForce(
        depth[i, k],
        speed[i, k],
        stiffness[i],
        exponent,
        springDeceleration[i, k],
        damping[i],
        logarithmAtSeparation[i]) else 0;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.NormalForce.memorylessForce\">NormalForce.memorylessForce</a> to each point.</p>
</html>"));
end memorylessForces;
