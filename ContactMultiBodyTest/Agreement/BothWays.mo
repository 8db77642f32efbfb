within ContactMultiBodyTest.Agreement;
model BothWays "The same contacts by the equations of the library and by the engine"
  extends Modelica.Icons.Example;
  parameter String shape[3]={ContactMultiBody.Shapes.box({0.2,0.3,0.25}),ContactMultiBody.Shapes.capsule(0.1, 0.2),
    ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(0.1, {0.1,0,0}),ContactMultiBody.Shapes.box({0.3,0.1,0.1})})}
    "Geometries of the moved bodies";
  parameter ContactMultiBody.Types.NormalLaw law=ContactMultiBody.Types.NormalLaw.Exact "Law of the normal force"
    annotation (Evaluate=true);
  parameter Boolean useRestitution=true "= true, if restitution is delivered" annotation (Evaluate=true, choices(checkBox=true));
  parameter ContactMultiBody.Types.Friction friction=ContactMultiBody.Types.Friction.Regularised "Law of friction, without anchors"
    annotation (Evaluate=true);
  parameter Boolean turning=false "= true, if spin and rolling friction act" annotation (Evaluate=true, choices(checkBox=true));
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  MovedBody body[3](phase={0.1,1.3,2.2}, each size=0.2, each center={0,0,0.22});
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    material={ContactMultiBody.Materials.Material(restitution=0.2, muStatic=0.1, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.4, muStatic=0.2, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.9, muStatic=0.4, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.8, muStatic=0.3, muDynamic=0.5)},
    inertia={ContactMultiBody.Parts.Inertia(m=1, I={{0.004,0,0},{0,0.005,0},{0,0,0.006}}),
      ContactMultiBody.Parts.Inertia(m=2, r_CM={0.01,0,0.02}, I={{0.006,0.001,0},{0.001,0.007,0},{0,0,0.008}}),
      ContactMultiBody.Parts.Inertia(m=3, r_CM={0,0.03,0}, I={{0.01,0,0.002},{0,0.02,0},{0.002,0,0.015}}),
      ContactMultiBody.Parts.Inertia()},
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless,
    useRestitution=useRestitution,
    normalLaw=law,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={5e4,5e4,1e5,5e4,1e5,1e5},
    friction=friction,
    restitutionRule=ContactMultiBody.Types.CombinationRule.HarmonicMean,
    frictionRule=ContactMultiBody.Types.CombinationRule.ArithmeticMean,
    useTurningFriction=turning,
    spinRadius=fill(0.02, 6),
    rollingLever=fill(0.01, 6),
    pointCapacity=24);
  ContactMultiBody.CompiledContactManager compiled(
    n=4,
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    material={ContactMultiBody.Materials.Material(restitution=0.2, muStatic=0.1, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.4, muStatic=0.2, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.9, muStatic=0.4, muDynamic=0.5),
      ContactMultiBody.Materials.Material(restitution=0.8, muStatic=0.3, muDynamic=0.5)},
    inertia={ContactMultiBody.Parts.Inertia(m=1, I={{0.004,0,0},{0,0.005,0},{0,0,0.006}}),
      ContactMultiBody.Parts.Inertia(m=2, r_CM={0.01,0,0.02}, I={{0.006,0.001,0},{0.001,0.007,0},{0,0,0.008}}),
      ContactMultiBody.Parts.Inertia(m=3, r_CM={0,0.03,0}, I={{0.01,0,0.002},{0,0.02,0},{0.002,0,0.015}}),
      ContactMultiBody.Parts.Inertia()},
    useRestitution=useRestitution,
    normalLaw=law,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e5,1e5,1e5,Modelica.Constants.inf},
    useFriction=friction == ContactMultiBody.Types.Friction.Regularised,
    restitutionRule=ContactMultiBody.Types.CombinationRule.HarmonicMean,
    frictionRule=ContactMultiBody.Types.CombinationRule.ArithmeticMean,
    spinRadius=if turning then 0.02 else 0,
    rollingLever=if turning then 0.01 else 0);
  WrenchComparison comparison(n=4);
equation
  for i in 1:3 loop
    connect(body[i].frame_a, contacts.frame[i]);
  end for;
  connect(floor.frame_a, contacts.frame[4]);
  for i in 1:3 loop
    connect(body[i].frame_a, compiled.frame[i]);
  end for;
  connect(floor.frame_a, compiled.frame[4]);
  for i in 1:4 loop
    comparison.force[i, 1, :] = contacts.frame[i].f;
  end for;
  for i in 1:4 loop
    comparison.force[i, 2, :] = compiled.frame[i].f;
  end for;
  for i in 1:4 loop
    comparison.torque[i, 1, :] = contacts.frame[i].t;
  end for;
  for i in 1:4 loop
    comparison.torque[i, 2, :] = compiled.frame[i].t;
  end for;
  comparison.energy = {contacts.elasticEnergy,compiled.elasticEnergy};
  annotation (experiment(StopTime=50, Tolerance=1e-6, Interval=0.1), Documentation(info="<html>
<p>Bodies 1 to 3 move, body 4 is the ground. The equations get room for all points of a pair: nothing is merged.</p>
</html>"));
end BothWays;
