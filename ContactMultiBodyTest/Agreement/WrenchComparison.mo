within ContactMultiBodyTest.Agreement;
block WrenchComparison "How far two ways to compute the wrenches on bodies differ"
  parameter Integer n=2 "Number of bodies" annotation (Evaluate=true);
  input Modelica.Units.SI.Force force[n, 2, 3] "Force on each body both ways";
  input Modelica.Units.SI.Torque torque[n, 2, 3] "Torque on each body both ways";
  input Modelica.Units.SI.Energy energy[2] "Elastic energy both ways";
  Modelica.Units.SI.Force forceDifference=max(abs(force[:, 1, :] - force[:, 2, :])) "Largest difference of a force";
  Modelica.Units.SI.Torque torqueDifference=max(abs(torque[:, 1, :] - torque[:, 2, :])) "Largest difference of a torque";
  Modelica.Units.SI.Energy energyDifference=abs(energy[1] - energy[2]) "Difference of the energies";
  Modelica.Units.SI.Force largestForce=max(abs(force[:, 1, :])) "Largest component of a force";
  Modelica.Units.SI.Torque largestTorque=max(abs(torque[:, 1, :])) "Largest component of a torque";
  annotation (Documentation(info="<html>
<p>The model that holds it equates the arrays.</p>
</html>"));
end WrenchComparison;
