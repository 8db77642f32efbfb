within ContactMultiBody.Examples;
model NewtonCradle "The last of five balls leaves with the speed of the first"
  extends Modelica.Icons.Example;
  final parameter Integer n=5 "Number of balls" annotation (Evaluate=true);
  parameter Modelica.Units.SI.Angle phi0=0.5 "Angle from which the first ball is let go";
  final parameter Modelica.Units.SI.Radius radius=0.02 "Radius of the balls";
  final parameter Modelica.Units.SI.Length length=0.2 "Length of the strings";
  final parameter Modelica.Units.SI.Distance gap=1e-4 "Gap between the balls at rest";
  final parameter Modelica.Units.SI.Mass m=4/3*Modelica.Constants.pi*radius^3*7850 "Mass of a ball";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Modelica.Mechanics.MultiBody.Parts.FixedTranslation hook[n](r={{(i - 1)*(2*radius + gap),0,0} for i in 1:n}, each animation=false)
    annotation (Placement(transformation(extent={{-60,20},{-40,40}})));
  Modelica.Mechanics.MultiBody.Joints.Revolute string[n](
    each n={0,1,0},
    phi(start={if i == 1 then phi0 else 0 for i in 1:n}, each fixed=true),
    w(each fixed=true),
    each cylinderDiameter=0.005) annotation (Placement(transformation(extent={{-30,20},{-10,40}})));
  Parts.Body ball[n](
    each m=m,
    each r_CM={0,0,-length},
    each I_11=0.4*m*radius^2,
    each I_22=0.4*m*radius^2,
    each I_33=0.4*m*radius^2,
    each geometry=Shapes.sphere(radius, {0,0,-length}),
    each material=Materials.Steel(restitution=1),
    each sphereDiameter=2*radius,
    each cylinderDiameter=0.002) annotation (Placement(transformation(extent={{0,20},{20,40}})));
  ContactManager contacts(
    n=n,
    geometry={ball[i].geometry for i in 1:n},
    material={ball[i].material for i in 1:n},
    pairs={{i,i + 1} for i in 1:n - 1},
    pointCapacity=1,
    contactRadius=fill(radius/2, n - 1),
    friction=Types.Friction.None) annotation (Placement(transformation(extent={{40,-20},{80,20}})));
equation
  for i in 1:n loop
    connect(world.frame_b, hook[i].frame_a) annotation (Line(points={{-80,-90},{-70,-90},{-70,30},{-60,30}}, color={95,95,95}));
    connect(hook[i].frame_b, string[i].frame_a) annotation (Line(points={{-40,30},{-30,30}}, color={95,95,95}));
    connect(string[i].frame_b, ball[i].frame_a) annotation (Line(points={{-10,30},{0,30}}, color={95,95,95}));
    connect(ball[i].frame_a, contacts.frame[i]) annotation (Line(points={{0,30},{-4,30},{-4,0},{40,0}}, color={95,95,95}));
  end for;
  annotation (
    experiment(StopTime=0.9, Tolerance=1e-8, Interval=0.001),
    Documentation(info="<html>
<p>
The first ball is let go at 0.5 rad and strikes the second; the last one leaves and rises to the same angle on the other side, while the
others nearly stand still: plot <code>string.phi</code>. The stiffness is Hertz's of steel spheres; each impact lasts about a tenth of a millisecond.
</p>
</html>"));
end NewtonCradle;
