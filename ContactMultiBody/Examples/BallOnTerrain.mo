within ContactMultiBody.Examples;
model BallOnTerrain "A ball comes to rest at the bottom of a hollow given by heights"
  extends Modelica.Icons.Example;
  parameter Real slope(unit="1")=0.1 "Gradient of the ground from its middle to the next height";
  final parameter Modelica.Units.SI.Radius radius=0.1 "Radius of the ball";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the ball";
  final parameter Real K(unit="N/m")=1e5 "Stiffness";
  final parameter Modelica.Units.SI.Position height[9, 9]={{0.25*slope*((i - 5)^2 + (j - 5)^2) for j in 1:9} for i in 1:9} "Heights over a grid of 0.25 m";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody ball(
    m=m,
    r_CM={0,0,0},
    I_11=0.4*m*radius^2,
    I_22=0.4*m*radius^2,
    I_33=0.4*m*radius^2,
    geometry=Shapes.sphere(radius),
    material=Materials.Material(restitution=0.3),
    r_0(start={0.6,0.2,0.4}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.2) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground ground(geometry=Shapes.heightField({2,2}, height), material=Materials.Material(restitution=0.3))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={ball.geometry,ground.geometry},
    material={ball.material,ground.material},
    pointCapacity=4,
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K},
    useTurningFriction=true,
    rollingLever={0.004}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(ball.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(ground.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=12, Tolerance=1e-7, Interval=0.01),
    Documentation(info="<html>
<p>
The heights lie on a paraboloid; between them the ground is flat. The ball rolls to and fro over the edges of the triangles
and ends in the middle, where it touches all four around: where the
ground rises by slope along x and along y, so that its centre rests at radius sqrt(1 + 2 slope<sup>2</sup>) - m g/K. Plot <code>ball.r_0</code>.
</p>
</html>"));
end BallOnTerrain;
