within ContactMultiBody.Internal.Resultants;
pure function bodyTorques "Resultant contact torque on each body about the origin of its frame"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Modelica.Units.SI.Force force[size(depth, 1), size(depth, 2), 3] "Forces of the points on the first bodies";
  input Modelica.Units.SI.Position point[size(force, 1), size(force, 2), 3] "Contact points";
  input Modelica.Units.SI.Position r_0[:, 3] "Origins of the bodies' frames";
  input Integer pairs[size(force, 1), 2] "Bodies of each pair";
  output Modelica.Units.SI.Torque resultant[size(r_0, 1), 3] "Torques on the bodies, in world axes";
algorithm
  resultant := zeros(size(r_0, 1), 3);
  for i in 1:size(force, 1) loop
    for k in 1:size(force, 2) loop
      resultant[pairs[i, 1], :] := resultant[pairs[i, 1], :] +
        (if depth[i, k] > 0 then cross(point[i, k, :] - r_0[pairs[i, 1], :], force[i, k, :]) else zeros(3));
      resultant[pairs[i, 2], :] := resultant[pairs[i, 2], :] -
        (if depth[i, k] > 0 then cross(point[i, k, :] - r_0[pairs[i, 2], :], force[i, k, :]) else zeros(3));
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Both bodies feel the force at the same point, so that contacts change neither momentum nor angular momentum of the whole.</p>
</html>"));
end bodyTorques;
