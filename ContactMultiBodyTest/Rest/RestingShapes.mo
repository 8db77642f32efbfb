within ContactMultiBodyTest.Rest;
model RestingShapes "A cone, an ellipsoid and a compound come to rest"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Shapes;
  final parameter Modelica.Units.SI.Mass m=2 "Mass of each body";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contacts";
  final parameter Modelica.Units.SI.Radius radius=0.05 "Radius of the balls of the compound";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body body[3](
    each m=m,
    r_CM={{0,0,-0.05},{0,0,0},{0,0,0}},
    each I_11=0.02,
    each I_22=0.02,
    each I_33=0.02,
    geometry={Shapes.cone(0.1, 0.2),Shapes.ellipsoid({0.4,0.3,0.2}),Shapes.compound({Shapes.sphere(radius, {-0.1,0,0}),Shapes.sphere(
        radius, {0.3,0,0})})},
    each material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.5),
    r_0(start={{0,0,0.101},{1,0,0.101},{2,0,0.051}}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.5));
  ContactMultiBody.ContactManager contacts(
    n=4,
    geometry={body[1].geometry,body[2].geometry,body[3].geometry,floor.geometry},
    material={body[1].material,body[2].material,body[3].material,floor.material},
    pairs={{1,4},{2,4},{3,4}},
    friction=ContactMultiBody.Types.Friction.Anchored,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness=fill(K, 3));
  Modelica.Units.SI.Length depth[4] "Depths of cone, ellipsoid, left and right ball of the compound";
equation
  depth[1] = 0.1 - body[1].r_0[3];
  depth[2] = 0.1 - body[2].r_0[3];
  depth[3] = radius - body[3].r_0[3] + 0.1*body[3].frame_a.R.T[1, 3];
  depth[4] = radius - body[3].r_0[3] - 0.3*body[3].frame_a.R.T[1, 3];
  for i in 1:3 loop
    connect(body[i].frame_a, contacts.frame[i]);
  end for;
  connect(floor.frame_a, contacts.frame[4]);
  annotation (experiment(StopTime=20, Tolerance=1e-6, Interval=0.02), Documentation(info="<html>
<p>
The cone stands on its base and the ellipsoid on its flat side, both at the depth m g/K; the balls of the compound carry 3/4 and 1/4 of its weight.
</p>
</html>"));
end RestingShapes;
