within ContactMultiBody.Examples;
model BallAgainstThinWall "A fast ball does not pass a wall thinner than itself"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Velocity speed=50 "Speed of the ball";
  final parameter Modelica.Units.SI.Radius radius=0.005 "Radius of the ball";
  final parameter Modelica.Units.SI.Mass m=4/3*Modelica.Constants.pi*radius^3*7850 "Mass of the ball";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity)
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody ball(
    m=m,
    r_CM={0,0,0},
    I_11=0.4*m*radius^2,
    I_22=0.4*m*radius^2,
    I_33=0.4*m*radius^2,
    geometry=Shapes.sphere(radius),
    material=Materials.Steel(restitution=0.8),
    r_0(start={-0.2,0,0}, each fixed=true),
    v_0(start={speed,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=2*radius) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground wall(geometry=Shapes.box({0.005,0.5,0.5}), material=Materials.Steel(restitution=0.8))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={ball.geometry,wall.geometry},
    material={ball.material,wall.material},
    pointCapacity=1,
    contactRadius={radius},
    friction=Types.Friction.None) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(ball.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(wall.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=0.01, Tolerance=1e-8, Interval=1e-5),
    Documentation(info="<html>
<p>
A steel ball of 10 mm flies at 50 m/s against a steel wall of 5 mm and comes back with 0.8 of its speed, 40 m/s: plot
<code>ball.v_0[1]</code>. The contact is found by the crossing of a continuous distance, so that no step of the integrator can miss it as long as one step does not cross the wall
wholly; see <a href=\"modelica://ContactMultiBody.UsersGuide.Numerics\">Numerics</a>.
</p>
</html>"));
end BallAgainstThinWall;
