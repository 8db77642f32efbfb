within ContactMultiBody.Internal.Kinematics;
pure function pointVelocities "Velocities of the first bodies against the second at the points where they touch"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Modelica.Units.SI.Position point[size(depth, 1), size(depth, 2), 3] "Contact points";
  input Modelica.Units.SI.Position r_0[:, 3] "Origins of the bodies' frames";
  input Modelica.Units.SI.Velocity v_0[size(r_0, 1), 3] "Velocities of the origins";
  input Modelica.Units.SI.AngularVelocity w_0[size(r_0, 1), 3] "Angular velocities, in world axes";
  input Integer pairs[size(point, 1), 2] "Bodies of each pair";
  output Modelica.Units.SI.Velocity velocity[size(point, 1), size(point, 2), 3] "Relative velocities, in world axes; 0 at points that do not touch";
protected
  Integer a "First body";
  Integer b "Second body";
algorithm
  for i in 1:size(point, 1) loop
    a := pairs[i, 1];
    b := pairs[i, 2];
    for k in 1:size(point, 2) loop
      velocity[i, k, :] := if depth[i, k] > 0 then v_0[a, :] + cross(w_0[a, :], point[i, k, :] - r_0[a, :]) - v_0[b, :] -
        cross(w_0[b, :], point[i, k, :] - r_0[b, :]) else zeros(3);
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Rigid bodies: velocity of the origin plus angular velocity times lever.</p>
</html>"));
end pointVelocities;
