within ContactMultiBody.Internal.NormalForces;
pure function springDamperForces "Normal forces of all points by spring and damper"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Real weight[size(depth, 1), size(depth, 2)](each unit="1") "Weights of the points";
  input Modelica.Units.SI.Velocity speed[size(depth, 1), size(depth, 2)] "Approach speeds";
  input Real stiffness[size(depth, 1)] "Stiffness of each pair";
  input Real exponent(unit="1") "Exponent of the depth";
  input Modelica.Units.SI.TranslationalDampingConstant damping[size(depth, 1)] "Damping constant of each pair";
  input Modelica.Units.SI.Length dampingDepth "Depth from which dampers act fully";
  output Modelica.Units.SI.Force force[size(depth, 1), size(depth, 2)] "Normal forces";
algorithm
  for i in 1:size(depth, 1) loop
    for k in 1:size(depth, 2) loop
      force[i, k] := if depth[i, k] > 0 then weight[i, k]*NormalForce.springDamper(depth[i, k], speed[i, k], stiffness[i],
        exponent, damping[i], dampingDepth) else 0;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.NormalForce.springDamper\">NormalForce.springDamper</a> to each point.</p>
</html>"));
end springDamperForces;
