within ContactMultiBodyTest.Sliding;
model TurningFaces "Faces that turn on a floor, one of them while it slides, by points and by volumes"
  extends Modelica.Icons.Example;
  constant ContactMultiBody.Types.Friction anchored=ContactMultiBody.Types.Friction.Anchored "Law of friction";
  constant ContactMultiBody.Types.StiffnessChoice given=ContactMultiBody.Types.StiffnessChoice.Given "Where the stiffness comes from";
  parameter Modelica.Units.SI.Mass m=1 "Mass of each body";
  parameter Modelica.Units.SI.Length a=0.2 "Edge of the boxes, radius of the discs";
  parameter Modelica.Units.SI.Length height=0.05 "Height of the discs";
  parameter Real mu(unit="1")=0.4 "Coefficient of friction";
  parameter Real K(unit="N/m")=1e6 "Stiffness";
  parameter Real k(unit="N/m3")=1e8 "Foundation modulus";
  parameter Modelica.Units.SI.AngularVelocity w0=5 "Angular velocity at the start";
  parameter Modelica.Units.SI.Velocity v0=0.3 "Speed of the plate at the start";
  final parameter Modelica.Units.SI.Length settled=m*world.g/K "Depth at which the floor carries a body";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body box[2](
    each m=m,
    each r_CM={0,0,0},
    each I_11=m*a^2/6,
    each I_22=m*a^2/6,
    each I_33=m*a^2/6,
    each geometry=ContactMultiBody.Shapes.box({a,a,a}),
    r_0(start={{0,0,a/2 - settled},{0,1,a/2 - m*world.g/(k*a^2)}}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each w_0_start={0,0,w0});
  ContactMultiBody.Parts.Body disc[2](
    each m=m,
    each r_CM={0,0,0},
    each I_11=m*(a^2/4 + height^2/12),
    each I_22=m*(a^2/4 + height^2/12),
    each I_33=m*a^2/2,
    each geometry=ContactMultiBody.Shapes.cylinder(a, height),
    r_0(start={{1,0,height/2 - settled},{1,1,height/2 - m*world.g/(k*Modelica.Constants.pi*a^2)}}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each w_0_start={0,0,w0});
  ContactMultiBody.Parts.Body plate(
    m=m,
    r_CM={0,0,0},
    I_11=m*0.01,
    I_22=m*0.01,
    I_33=m*0.0125,
    geometry=ContactMultiBody.Shapes.box({0.3,0.2,0.001}),
    r_0(start={2,0,0.0005 - settled}, each fixed=true),
    v_0(start={v0,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,0,w0});
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager points(
    n=4,
    geometry={box[1].geometry,disc[1].geometry,plate.geometry,floor.geometry},
    material={box[1].material,disc[1].material,plate.material,floor.material},
    pairs={{1,4},{2,4},{3,4}},
    stiffnessChoice=given,
    stiffness=fill(K, 3),
    muDynamic=fill(mu, 3),
    muStatic=fill(mu, 3),
    friction=anchored);
  ContactMultiBody.VolumeContactManager volumes(
    n=3,
    geometry={box[2].geometry,disc[2].geometry,floor.geometry},
    material={box[2].material,disc[2].material,floor.material},
    pairs={{1,3},{2,3}},
    foundationModulus=fill(k, 2),
    frictionStiffness=fill(K, 2),
    muDynamic=fill(mu, 2),
    muStatic=fill(mu, 2),
    friction=anchored);
equation
  connect(box[1].frame_a, points.frame[1]);
  connect(disc[1].frame_a, points.frame[2]);
  connect(plate.frame_a, points.frame[3]);
  connect(floor.frame_a, points.frame[4]);
  connect(box[2].frame_a, volumes.frame[1]);
  connect(disc[2].frame_a, volumes.frame[2]);
  connect(floor.frame_a, volumes.frame[3]);
  annotation (experiment(StopTime=0.3, Tolerance=1e-7, Interval=0.005), Documentation(info="<html>
<p>The friction of a face is that of its points. Boxes and discs turn on the spot; the plate slides and turns, and stops doing both at the same time.</p>
</html>"));
end TurningFaces;
