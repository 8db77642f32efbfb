within ContactMultiBodyTest.Scenes;
model AllShapes "Every function of Shapes gives a descriptor the engine takes"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  parameter String shape[12]={
    ContactMultiBody.Shapes.sphere(0.1, {0,0,0.01}),
    ContactMultiBody.Shapes.box({0.1,0.2,0.3}, {0,0,0}, {{0,1,0},{-1,0,0},{0,0,1}}),
    ContactMultiBody.Shapes.capsule(0.05, 0.2),
    ContactMultiBody.Shapes.cylinder(0.05, 0.2),
    ContactMultiBody.Shapes.cone(0.05, 0.2),
    ContactMultiBody.Shapes.ellipsoid({0.1,0.2,0.3}),
    ContactMultiBody.Shapes.hull({{0,0,0},{0.1,0,0},{0,0.1,0},{0,0,0.1}}),
    ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(0.1),ContactMultiBody.Shapes.sphere(0.1, {0.1,0,0})}),
    "cmb/1 hull vertices=0,0,0,0.1,0,0,0,0.1,0,0,0,0.1",
    "",
    ContactMultiBody.Shapes.mesh({{0,0,0},{0.1,0,0},{0,0.1,0},{0,0,0.1}}, {{1,3,2},{1,2,4},{1,4,3},{2,3,4}}),
    ContactMultiBody.Shapes.heightField({0.2,0.3}, {{0,0.01},{0.02,0.01},{0,0}})} "Geometries";
  ContactMultiBody.Parts.Body body[12](
    each m=1,
    each r_CM={0,0,0},
    geometry=shape,
    r_0(start={{i,0,0.5} for i in 1:12}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=13,
    geometry={shape[1],shape[2],shape[3],shape[4],shape[5],shape[6],shape[7],shape[8],shape[9],shape[10],shape[11],shape[12],floor.geometry},
    pairs={{i,13} for i in 1:12},
    friction=ContactMultiBody.Types.Friction.None);
equation
  for i in 1:12 loop
    connect(body[i].frame_a, contacts.frame[i]);
  end for;
  connect(floor.frame_a, contacts.frame[13]);
  annotation (experiment(StopTime=0.01, Tolerance=1e-6), Documentation(info="<html>
<p>Twelve bodies fall on a floor.</p>
</html>"));
end AllShapes;
