within ContactMultiBodyTest.Scenes;
model AllParts "Every body of Parts can be part of a scene"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.BodyBox box(
    r={0.2,0,0},
    r_0(start={0,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.BodyCylinder cylinder(
    r={0.2,0,0},
    r_0(start={1,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.BodyShape body(
    m=1,
    r={0.2,0,0},
    r_CM={0.1,0,0},
    geometry=ContactMultiBody.Shapes.capsule(0.02, 0.2),
    material=ContactMultiBody.Materials.Wood(),
    r_0(start={2,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.CollisionShape tip(geometry=ContactMultiBody.Shapes.sphere(0.03), material=ContactMultiBody.Materials.Rubber());
  ContactMultiBody.Parts.Fixed fixed(r={5,0,0}, geometry=ContactMultiBody.Shapes.box({1,1,1}), material=ContactMultiBody.Materials.Concrete());
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Ice());
  ContactMultiBody.ContactManager contacts(
    n=6,
    geometry={box.geometry,cylinder.geometry,body.geometry,tip.geometry,fixed.geometry,floor.geometry},
    material={box.material,cylinder.material,body.material,tip.material,fixed.material,floor.material},
    pairs={{1,6},{2,6},{3,6},{4,6},{3,5}});
equation
  connect(box.frame_a, contacts.frame[1]);
  connect(cylinder.frame_a, contacts.frame[2]);
  connect(body.frame_a, contacts.frame[3]);
  connect(body.frame_b, tip.frame_a);
  connect(tip.frame_a, contacts.frame[4]);
  connect(fixed.frame_b, contacts.frame[5]);
  connect(floor.frame_a, contacts.frame[6]);
  annotation (experiment(StopTime=0.01, Tolerance=1e-6), Documentation(info="<html>
<p>One of each kind, connected to one ContactManager.</p>
</html>"));
end AllParts;
