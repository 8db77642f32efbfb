within ContactMultiBodyTest.Impacts;
model BallAgainstWall "A small steel ball flies against a thin steel wall"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Velocity speed=20 "Speed of the ball";
  final parameter Modelica.Units.SI.Radius radius=0.005 "Radius of the ball";
  final parameter Modelica.Units.SI.Length thickness=0.005 "Thickness of the wall";
  final parameter Modelica.Units.SI.Mass m=7800*4/3*Modelica.Constants.pi*radius^3 "Mass of the ball";
  final parameter ContactMultiBody.Materials.Material steel(E=2.1e11, nu=0.3, restitution=0.8, muStatic=0.2) "Material of both";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body ball(
    m=m,
    r_CM={0,0,0},
    I_11=2/5*m*radius^2,
    I_22=2/5*m*radius^2,
    I_33=2/5*m*radius^2,
    geometry=ContactMultiBody.Shapes.sphere(radius),
    material=steel,
    r_0(start={-0.05,0,0}, each fixed=true),
    v_0(start={speed,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground wall(
    r={thickness/2,0,0},
    geometry=ContactMultiBody.Shapes.box({thickness,0.2,0.2}),
    material=steel);
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={ball.geometry,wall.geometry},
    material={ball.material,wall.material},
    pointCapacity=1,
    contactRadius={radius});
equation
  connect(ball.frame_a, contacts.frame[1]);
  connect(wall.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.02, Tolerance=1e-8, Interval=1e-4), Documentation(info="<html>
<p>The near face of the wall is x = 0. The ball must come back with restitution times its speed.</p>
</html>"));
end BallAgainstWall;
