within ContactMultiBodyTest.Sliding;
model SpinningFaces "A box and a disc spin on the spot, flat on a floor"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Mass m=1 "Mass of each body";
  parameter Modelica.Units.SI.Length a=0.2 "Edge of the box, radius of the disc";
  parameter Modelica.Units.SI.Length height=0.05 "Height of both";
  parameter Real mu(unit="1")=0.4 "Coefficient of friction";
  parameter Real K(unit="N/m")=1e6 "Stiffness";
  parameter Modelica.Units.SI.AngularVelocity w0=5 "Angular velocity at the start";
  final parameter Modelica.Units.SI.Length settled=m*world.g/K "Depth at which the floor carries a body";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(a^2 + height^2)/12,
    I_22=m*(a^2 + height^2)/12,
    I_33=m*a^2/6,
    geometry=ContactMultiBody.Shapes.box({a,a,height}),
    r_0(start={0,0,height/2 - settled}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,0,w0},
    animation=false);
  ContactMultiBody.Parts.Body disc(
    m=m,
    r_CM={0,0,0},
    I_11=m*(a^2/4 + height^2/12),
    I_22=m*(a^2/4 + height^2/12),
    I_33=m*a^2/2,
    geometry=ContactMultiBody.Shapes.cylinder(a, height),
    r_0(start={1,0,height/2 - settled}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,0,w0},
    animation=false);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=3,
    geometry={box.geometry,disc.geometry,floor.geometry},
    material={box.material,disc.material,floor.material},
    pairs={{1,3},{2,3}},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness=fill(K, 2),
    muDynamic=fill(mu, 2),
    muStatic=fill(mu, 2),
    friction=ContactMultiBody.Types.Friction.Anchored,
    useRestitution=false);
equation
  connect(box.frame_a, contacts.frame[1]);
  connect(disc.frame_a, contacts.frame[2]);
  connect(floor.frame_a, contacts.frame[3]);
  annotation (experiment(StopTime=0.3, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
Faces are carried by points on their rims: the box by its corners at a/&radic;2 from the axis, the disc by points at a. With
friction &mu; m g at that lever, the box loses 6 &mu; g/(&radic;2 a) of its angular velocity in a second, the disc 2 &mu; g/a.
</p>
</html>"));
end SpinningFaces;
