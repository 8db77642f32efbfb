within ContactMultiBody.Internal.FreeBodies;
pure function quaternionRates "Derivatives of bodies' quaternions"
  extends Modelica.Icons.Function;
  input Real Q[:, 4](each unit="1") "Quaternion of each body";
  input Modelica.Units.SI.AngularVelocity w[size(Q, 1), 3] "Angular velocities, in the bodies' axes";
  output Real rate[size(Q, 1), 4](each unit="1/s") "Derivatives";
protected
  constant Real stabilisation(unit="1/s")=1 "Rate at which the length returns to 1";
  Real c(unit="1/s") "Correction of the length";
algorithm
  for i in 1:size(Q, 1) loop
    c := stabilisation*(1 - Q[i, 1]^2 - Q[i, 2]^2 - Q[i, 3]^2 - Q[i, 4]^2);
    rate[i, 1] := (Q[i, 4]*w[i, 1] - Q[i, 3]*w[i, 2] + Q[i, 2]*w[i, 3])/2 + c*Q[i, 1];
    rate[i, 2] := (Q[i, 3]*w[i, 1] + Q[i, 4]*w[i, 2] - Q[i, 1]*w[i, 3])/2 + c*Q[i, 2];
    rate[i, 3] := (-Q[i, 2]*w[i, 1] + Q[i, 1]*w[i, 2] + Q[i, 4]*w[i, 3])/2 + c*Q[i, 3];
    rate[i, 4] := -(Q[i, 1]*w[i, 1] + Q[i, 2]*w[i, 2] + Q[i, 3]*w[i, 3])/2 + c*Q[i, 4];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
The differential equation keeps the length of a quaternion; a correction along the quaternion, which turns nothing, takes away what the integrator's errors
add (Baumgarte 1972).
</p>
</html>"));
end quaternionRates;
