within ContactMultiBodyTest.Rest;
model VolumeStack "A ball and a board on two boxes, by the volume law"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Shapes;
  final parameter Real k(unit="N/m3")=1e8 "Pressure by depth";
  final parameter Modelica.Units.SI.Mass m[2]={2,3} "Masses of the board and of the ball";
  final parameter Modelica.Units.SI.Radius radius=0.05 "Radius of the ball";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body board(
    m=m[1],
    r_CM={0,0,0},
    I_11=0.01,
    I_22=0.03,
    I_33=0.03,
    geometry=Shapes.box({0.5,0.2,0.02}),
    material=ContactMultiBody.Materials.Material(restitution=0.1),
    r_0(start={0,0,0.0101}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Body ball(
    m=m[2],
    r_CM={0,0,0},
    I_11=2/5*m[2]*radius^2,
    I_22=2/5*m[2]*radius^2,
    I_33=2/5*m[2]*radius^2,
    geometry=Shapes.sphere(radius),
    material=ContactMultiBody.Materials.Material(restitution=0.1),
    r_0(start={1,0,radius + 1e-4}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground supports(geometry=Shapes.compound({Shapes.box({0.1,0.3,0.2}, {-0.15,0,-0.1}),Shapes.box({0.1,0.3,
        0.2}, {0.15,0,-0.1})}), material=ContactMultiBody.Materials.Material(restitution=0.1));
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.1));
  ContactMultiBody.VolumeContactManager contacts(
    n=4,
    geometry={board.geometry,ball.geometry,supports.geometry,floor.geometry},
    material={board.material,ball.material,supports.material,floor.material},
    pairs={{1,3},{2,4}},
    foundationModulus={k,k});
  Modelica.Units.SI.Length depth[2] "Depths of the board and of the ball";
equation
  depth = {0.01 - board.r_0[3],radius - ball.r_0[3]};
  connect(board.frame_a, contacts.frame[1]);
  connect(ball.frame_a, contacts.frame[2]);
  connect(supports.frame_a, contacts.frame[3]);
  connect(floor.frame_a, contacts.frame[4]);
  annotation (experiment(StopTime=5, Tolerance=1e-6, Interval=0.01), Documentation(info="<html>
<p>
The board rests on two areas of 0.1 m by 0.2 m at the depth m g/(k A); the ball at the depth x whose cap has the volume m g/k = &pi; x<sup>2</sup> (3 r - x)/3.
</p>
</html>"));
end VolumeStack;
