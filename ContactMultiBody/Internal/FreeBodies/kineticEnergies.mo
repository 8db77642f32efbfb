within ContactMultiBody.Internal.FreeBodies;
pure function kineticEnergies "Kinetic energy of each of equal free bodies"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Mass m "Mass of each body";
  input Modelica.Units.SI.Inertia J[3] "Principal moments of inertia of each body";
  input Modelica.Units.SI.Velocity v[:, 3] "Velocities of the centres of mass";
  input Modelica.Units.SI.AngularVelocity w[size(v, 1), 3] "Angular velocities, in the bodies' axes";
  output Modelica.Units.SI.Energy energy[size(v, 1)] "Kinetic energies";
algorithm
  for i in 1:size(v, 1) loop
    energy[i] := (m*(v[i, :]*v[i, :]) + J[1]*w[i, 1]^2 + J[2]*w[i, 2]^2 + J[3]*w[i, 3]^2)/2;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>m v<sup>2</sup>/2 + w J w/2.</p>
</html>"));
end kineticEnergies;
