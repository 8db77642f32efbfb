within ContactMultiBody.Internal.Kinematics;
pure function approachSpeeds "Speeds along the normals where bodies touch, positive when they approach"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Modelica.Units.SI.Velocity velocity[size(depth, 1), size(depth, 2), 3] "Relative velocities at the points";
  input Real normal[size(velocity, 1), size(velocity, 2), 3](each unit="1") "Normals at the points";
  output Modelica.Units.SI.Velocity speed[size(velocity, 1), size(velocity, 2)] "Approach speeds; 0 at points that do not touch";
algorithm
  for i in 1:size(velocity, 1) loop
    for k in 1:size(velocity, 2) loop
      speed[i, k] := if depth[i, k] > 0 then -velocity[i, k, :]*normal[i, k, :] else 0;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Normals point from the second body to the first, hence the sign.</p>
</html>"));
end approachSpeeds;
