within ContactMultiBodyTest.Agreement;
model BoundedVolumeDistances "The same by the volume of the overlap"
  extends Modelica.Icons.Example;
  extends BoundsBesideDistances;
  ContactMultiBody.VolumeContactManager exact(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry});
  ContactMultiBody.VolumeContactManager bounded(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    exactWithin=0.02);
equation
  for i in 1:3 loop
    connect(body[i].frame_a, exact.frame[i]);
  end for;
  connect(floor.frame_a, exact.frame[4]);
  for i in 1:3 loop
    connect(body[i].frame_a, bounded.frame[i]);
  end for;
  connect(floor.frame_a, bounded.frame[4]);
  for i in 1:4 loop
    comparison.force[i, 1, :] = exact.frame[i].f;
  end for;
  for i in 1:4 loop
    comparison.force[i, 2, :] = bounded.frame[i].f;
  end for;
  for i in 1:4 loop
    comparison.torque[i, 1, :] = exact.frame[i].t;
  end for;
  for i in 1:4 loop
    comparison.torque[i, 2, :] = bounded.frame[i].t;
  end for;
  comparison.energy = {exact.elasticEnergy,bounded.elasticEnergy};
  impactDifference = max(abs(exact.impactSpeed - bounded.impactSpeed));
  excess = max(bounded.distance - exact.distance);
  shortfall = max(exact.distance - bounded.distance);
  annotation (experiment(StopTime=20, Tolerance=1e-6, Interval=0.02), Documentation(info="<html>
<p>Overlaps push the same to the bit, impacts are caught at the same times, and no bound exceeds the distance.</p>
</html>"));
end BoundedVolumeDistances;
