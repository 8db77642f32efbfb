within ContactMultiBody.Internal.FreeBodies;
pure function angularAccelerations "Euler's equations of equal free bodies in their principal axes"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Inertia J[3] "Principal moments of inertia of each body";
  input Modelica.Units.SI.AngularVelocity w[:, 3] "Angular velocities, in the bodies' axes";
  input Real T[size(w, 1), 3, 3](each unit="1") "Rotation from world to each body's frame";
  input Modelica.Units.SI.Torque torque[:, 3] "Torques about the centres of mass, in world axes; further rows are not used";
  output Modelica.Units.SI.AngularAcceleration z[size(w, 1), 3] "Angular accelerations, in the bodies' axes";
algorithm
  for i in 1:size(w, 1) loop
    z[i, 1] := (T[i, 1, :]*torque[i, :] + (J[2] - J[3])*w[i, 2]*w[i, 3])/J[1];
    z[i, 2] := (T[i, 2, :]*torque[i, :] + (J[3] - J[1])*w[i, 3]*w[i, 1])/J[2];
    z[i, 3] := (T[i, 3, :]*torque[i, :] + (J[1] - J[2])*w[i, 1]*w[i, 2])/J[3];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>J dw/dt + w &times; J w = T torque, in principal axes.</p>
</html>"));
end angularAccelerations;
