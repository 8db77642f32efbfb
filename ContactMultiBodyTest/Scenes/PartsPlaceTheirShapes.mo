within ContactMultiBodyTest.Scenes;
model PartsPlaceTheirShapes "The default geometry of BodyBox and BodyCylinder lies where the body is drawn"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.BodyBox standing(
    r={0,0,-0.3},
    width=0.1,
    height=0.2,
    r_0(start={0,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.BodyBox onItsSide(
    r={0,0.3,0},
    widthDirection={0,0,1},
    width=0.1,
    height=0.2,
    r_0(start={2,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.BodyCylinder upright(
    r={0,0,0.3},
    diameter=0.1,
    r_0(start={4,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.BodyCylinder lying(
    r={0.3,0.4,0},
    diameter=0.1,
    r_0(start={6,0,1}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.Parts.Ground wall(r={6,0.6,0}, normal={0,-1,0});
  ContactMultiBody.ContactManager contacts(
    n=6,
    geometry={standing.geometry,onItsSide.geometry,upright.geometry,lying.geometry,floor.geometry,wall.geometry},
    material={standing.material,onItsSide.material,upright.material,lying.material,floor.material,wall.material},
    pairs={{1,5},{2,5},{3,5},{4,5},{4,6}});
equation
  connect(standing.frame_a, contacts.frame[1]);
  connect(onItsSide.frame_a, contacts.frame[2]);
  connect(upright.frame_a, contacts.frame[3]);
  connect(lying.frame_a, contacts.frame[4]);
  connect(floor.frame_a, contacts.frame[5]);
  connect(wall.frame_a, contacts.frame[6]);
  annotation (experiment(StopTime=0.01, Tolerance=1e-6), Documentation(info="<html>
<p>
Distances to floor and wall follow from the sizes: 0.7, 0.95, 1 and 0.95 m to the floor; the lying cylinder ends
0.2 m less 0.03 m before the wall.
</p>
</html>"));
end PartsPlaceTheirShapes;
