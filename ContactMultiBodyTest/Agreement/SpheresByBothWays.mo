within ContactMultiBodyTest.Agreement;
model SpheresByBothWays "Forces between moved spheres by the equations of the library and by the engine"
  extends Modelica.Icons.Example;
  parameter ContactMultiBody.Types.NormalLaw law=ContactMultiBody.Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true);
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  MovedBody ball[4](phase={0.1,1.3,2.2,3.7}, each size=0.12, each center={0,0,0.18});
  ContactMultiBody.Parts.Ground floor(material(restitution=0.8, muStatic=0.3));
  ContactMultiBody.ContactManager contacts(
    n=5,
    geometry={ContactMultiBody.Shapes.sphere(0.1),ContactMultiBody.Shapes.sphere(0.12),ContactMultiBody.Shapes.sphere(0.09),
      ContactMultiBody.Shapes.sphere(0.1, {0.02,0.01,-0.03}),floor.geometry},
    material={ContactMultiBody.Materials.Material(restitution=0.2, muStatic=0.1, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.4, muStatic=0.2, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.6, muStatic=0.3, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.9, muStatic=0.4, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.8, muStatic=0.3, muDynamic=0.5)},
    inertia={ContactMultiBody.Parts.Inertia(m=1, I={{0.004,0,0},{0,0.005,0},{0,0,0.006}}),
      ContactMultiBody.Parts.Inertia(m=2, r_CM={0.01,0,0.02}, I={{0.006,0.001,0},{0.001,0.007,0},{0,0,0.008}}),
      ContactMultiBody.Parts.Inertia(m=0.5),
      ContactMultiBody.Parts.Inertia(m=3, r_CM={0,0.03,0}, I={{0.01,0,0.002},{0,0.02,0},{0.002,0,0.015}}),
      ContactMultiBody.Parts.Inertia()},
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless,
    normalLaw=law,
    contactRadius={1/(1/0.1 + 1/0.12),1/(1/0.1 + 1/0.09),0.05,0.1,1/(1/0.12 + 1/0.09),1/(1/0.12 + 1/0.1),0.12,1/(1/0.09 + 1/
      0.1),0.09,0.1},
    pointCapacity=1);
  ContactMultiBody.CompiledContactManager compiled(
    n=5,
    geometry={ContactMultiBody.Shapes.sphere(0.1),ContactMultiBody.Shapes.sphere(0.12),ContactMultiBody.Shapes.sphere(0.09),
      ContactMultiBody.Shapes.sphere(0.1, {0.02,0.01,-0.03}),floor.geometry},
    material={ContactMultiBody.Materials.Material(restitution=0.2, muStatic=0.1, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.4, muStatic=0.2, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.6, muStatic=0.3, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.9, muStatic=0.4, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.8, muStatic=0.3, muDynamic=0.5)},
    inertia={ContactMultiBody.Parts.Inertia(m=1, I={{0.004,0,0},{0,0.005,0},{0,0,0.006}}),
      ContactMultiBody.Parts.Inertia(m=2, r_CM={0.01,0,0.02}, I={{0.006,0.001,0},{0.001,0.007,0},{0,0,0.008}}),
      ContactMultiBody.Parts.Inertia(m=0.5),
      ContactMultiBody.Parts.Inertia(m=3, r_CM={0,0.03,0}, I={{0.01,0,0.002},{0,0.02,0},{0.002,0,0.015}}),
      ContactMultiBody.Parts.Inertia()},
    normalLaw=law,
    contactRadius={0.1,0.12,0.09,0.1,Modelica.Constants.inf});
  WrenchComparison comparison(n=5);
equation
  for i in 1:4 loop
    connect(ball[i].frame_a, contacts.frame[i]);
  end for;
  connect(floor.frame_a, contacts.frame[5]);
  for i in 1:4 loop
    connect(ball[i].frame_a, compiled.frame[i]);
  end for;
  connect(floor.frame_a, compiled.frame[5]);
  for i in 1:5 loop
    comparison.force[i, 1, :] = contacts.frame[i].f;
  end for;
  for i in 1:5 loop
    comparison.force[i, 2, :] = compiled.frame[i].f;
  end for;
  for i in 1:5 loop
    comparison.torque[i, 1, :] = contacts.frame[i].t;
  end for;
  for i in 1:5 loop
    comparison.torque[i, 2, :] = compiled.frame[i].t;
  end for;
  comparison.energy = {contacts.elasticEnergy,compiled.elasticEnergy};
  annotation (experiment(StopTime=50, Tolerance=1e-6, Interval=0.1), Documentation(info="<html>
<p><code>comparison.forceDifference</code>, <code>torqueDifference</code> and <code>energyDifference</code> stay zero to rounding.</p>
</html>"));
end SpheresByBothWays;
