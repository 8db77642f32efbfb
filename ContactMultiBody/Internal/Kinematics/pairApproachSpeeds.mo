within ContactMultiBody.Internal.Kinematics;
pure function pairApproachSpeeds "One approach speed of each pair from those of its points"
  extends Modelica.Icons.Function;
  input Real weight[:, :](each unit="1") "Weights of the points";
  input Real normal[size(weight, 1), size(weight, 2), 3](each unit="1") "Normals at the points";
  input Modelica.Units.SI.Position point[size(weight, 1), size(weight, 2), 3] "Contact points";
  input Modelica.Units.SI.Position r_0[:, 3] "Origins of the bodies' frames";
  input Modelica.Units.SI.Velocity v_0[size(r_0, 1), 3] "Velocities of the origins";
  input Modelica.Units.SI.AngularVelocity w_0[size(r_0, 1), 3] "Angular velocities, in world axes";
  input Integer pairs[size(weight, 1), 2] "Bodies of each pair";
  output Modelica.Units.SI.Velocity pairSpeed[size(weight, 1)] "Approach speeds of the pairs";
protected
  Integer a "First body";
  Integer b "Second body";
  Modelica.Units.SI.Velocity speed "Approach speed of a point, touching or not";
  Modelica.Units.SI.Velocity first "That of the first point of a pair";
  Modelica.Units.SI.Velocity weighted "Sum of the speeds of a pair's points by their weights";
  Real total(unit="1") "Sum of the weights of a pair";
algorithm
  for i in 1:size(weight, 1) loop
    a := pairs[i, 1];
    b := pairs[i, 2];
    first := 0;
    weighted := 0;
    total := 0;
    for k in 1:size(weight, 2) loop
      speed := (v_0[b, :] + cross(w_0[b, :], point[i, k, :] - r_0[b, :]) - v_0[a, :] - cross(w_0[a, :],
        point[i, k, :] - r_0[a, :]))*normal[i, k, :];
      first := if k == 1 then speed else first;
      weighted := weighted + weight[i, k]*speed;
      total := total + weight[i, k];
    end for;
    pairSpeed[i] := if total > 0 then weighted/total else first;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Mean by weight; before bodies touch, the speed at the points closest to each other, which the engine puts first.</p>
</html>"));
end pairApproachSpeeds;
