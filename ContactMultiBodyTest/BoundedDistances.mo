within ContactMultiBodyTest;
model BoundedDistances "Contacts and impacts of moved bodies with exact distances and with bounds where bodies are far apart"
  extends Modelica.Icons.Example;
  parameter String shape[3]={ContactMultiBody.Shapes.box({0.2,0.3,0.25}),ContactMultiBody.Shapes.cylinder(0.1, 0.2),
    ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(0.1, {0.1,0,0}),ContactMultiBody.Shapes.box({0.3,0.1,0.1})})}
    "Geometries of the moved bodies";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  MovedBody body[3](phase={0.1,1.3,2.2}, each size=0.5, each center={0,0,0.5});
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager exact(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given);
  ContactMultiBody.ContactManager bounded(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    exactWithin=0.02);
  WrenchComparison comparison(n=4);
  Modelica.Units.SI.Velocity impactDifference=max(abs(exact.impactSpeed - bounded.impactSpeed))
    "Largest difference of the speeds that events caught";
  Modelica.Units.SI.Length excess=max(bounded.distance - exact.distance) "Largest excess of a bound over the distance";
  Modelica.Units.SI.Length shortfall=max(exact.distance - bounded.distance) "Largest shortfall of a bound";
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
  annotation (experiment(StopTime=20, Tolerance=1e-6, Interval=0.02), Documentation(info="<html>
<p>Forces are the same to the bit, impacts are caught at the same times, and no bound exceeds the distance.</p>
</html>"));
end BoundedDistances;
