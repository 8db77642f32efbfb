within ContactMultiBody.Internal.Kinematics;
pure function approachSpeeds "Speeds along the normals, positive when bodies approach"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Velocity velocity[:, :, 3] "Relative velocities at the points";
  input Real normal[size(velocity, 1), size(velocity, 2), 3](each unit="1") "Normals at the points";
  output Modelica.Units.SI.Velocity speed[size(velocity, 1), size(velocity, 2)] "Approach speeds";
algorithm
  for i in 1:size(velocity, 1) loop
    for k in 1:size(velocity, 2) loop
      speed[i, k] := -velocity[i, k, :]*normal[i, k, :];
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Normals point from the second body to the first, hence the sign.</p>
</html>"));
end approachSpeeds;
