within ContactMultiBody.Internal.FrictionForces;
pure function turningTorques "Torques of spin and rolling friction on each body"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce[:, :] "Normal forces";
  input Real normal[size(normalForce, 1), size(normalForce, 2), 3](each unit="1") "Normals";
  input Modelica.Units.SI.AngularVelocity w_0[:, 3] "Angular velocities of the bodies, in world axes";
  input Integer pairs[size(normalForce, 1), 2] "Bodies of each pair";
  input Real mu[size(normalForce, 1)](each unit="1") "Coefficients of friction";
  input Modelica.Units.SI.Radius spinRadius[size(normalForce, 1)] "Radii of the areas of contact; 0: no spin friction";
  input Modelica.Units.SI.Length rollingLever[size(normalForce, 1)] "Coefficients of rolling friction; 0: none";
  input Modelica.Units.SI.AngularVelocity regularisationSpeed "Angular speed over which torques change direction";
  output Modelica.Units.SI.Torque torque[size(w_0, 1), 3] "Torques on the bodies, in world axes";
protected
  Modelica.Units.SI.AngularVelocity w[3] "Relative angular velocity";
  Modelica.Units.SI.Torque t[3] "Torque of a point on the first body";
algorithm
  torque := zeros(size(w_0, 1), 3);
  for i in 1:size(normalForce, 1) loop
    w := w_0[pairs[i, 1], :] - w_0[pairs[i, 2], :];
    for k in 1:size(normalForce, 2) loop
      t := Friction.spinTorque(normalForce[i, k], normal[i, k, :], w, mu[i], spinRadius[i], regularisationSpeed) +
        Friction.rollingTorque(normalForce[i, k], normal[i, k, :], w, rollingLever[i], regularisationSpeed);
      torque[pairs[i, 1], :] := torque[pairs[i, 1], :] + t;
      torque[pairs[i, 2], :] := torque[pairs[i, 2], :] - t;
    end for;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Sum of <a href=\"modelica://ContactMultiBody.Friction.spinTorque\">spinTorque</a> and
<a href=\"modelica://ContactMultiBody.Friction.rollingTorque\">rollingTorque</a> over all points.</p>
</html>"));
end turningTorques;
