within ContactMultiBodyTest;
model ShapesByBothWays "Forces between moved bodies of many shapes by the equations of the library and by the engine"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  parameter String shape[3]={ContactMultiBody.Shapes.box({0.2,0.3,0.25}),ContactMultiBody.Shapes.capsule(0.1, 0.2),
    ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(0.1, {0.1,0,0}),ContactMultiBody.Shapes.box({0.3,0.1,0.1})})} "Geometries of the moved bodies";
  MovedBody body[3](phase={0.1,1.3,2.2}, each size=0.2, each center={0,0,0.22});
  ContactMultiBody.Parts.Ground floor(material(restitution=0.8, muStatic=0.3));
  BothWays restitution(geometry={shape[1],shape[2],shape[3],floor.geometry});
  BothWays springDamper(
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    law=ContactMultiBody.Types.NormalLaw.SpringDamper,
    turning=true);
  BothWays constantDamping(
    geometry={shape[1],shape[2],shape[3],floor.geometry},
    useRestitution=false,
    friction=ContactMultiBody.Types.Friction.None);
equation
  for i in 1:3 loop
    connect(body[i].frame_a, restitution.frame[i]);
  end for;
  connect(floor.frame_a, restitution.frame[4]);
  for i in 1:3 loop
    connect(body[i].frame_a, springDamper.frame[i]);
  end for;
  connect(floor.frame_a, springDamper.frame[4]);
  for i in 1:3 loop
    connect(body[i].frame_a, constantDamping.frame[i]);
  end for;
  connect(floor.frame_a, constantDamping.frame[4]);
  annotation (experiment(StopTime=50, Tolerance=1e-6, Interval=0.1), Documentation(info="<html>
<p>The differences of each <code>comparison</code> stay zero to rounding.</p>
</html>"));
end ShapesByBothWays;
