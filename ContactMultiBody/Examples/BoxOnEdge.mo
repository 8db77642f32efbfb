within ContactMultiBody.Examples;
model BoxOnEdge "A box dropped on its edge tumbles and comes to lie flat"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Angle tilt=0.6 "Angle about the edge at the start";
  final parameter Modelica.Units.SI.Length size[3]={0.3,0.2,0.1} "Size of the box";
  final parameter Modelica.Units.SI.Mass m=3 "Mass of the box";
  final parameter Modelica.Units.SI.Inertia I[3]=m*{size[2]^2 + size[3]^2,size[1]^2 + size[3]^2,size[1]^2 + size[2]^2}/12
    "Principal moments of inertia";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody box(
    m=m,
    r_CM={0,0,0},
    I_11=I[1],
    I_22=I[2],
    I_33=I[3],
    geometry=Shapes.box(size),
    material=Materials.Material(restitution=0.4, muStatic=0.5),
    r_0(start={0,0,0.5}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={0,tilt,0},
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.4, muStatic=0.5))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={box.geometry,floor.geometry},
    material={box.material,floor.material},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={1e6},
    friction=Types.Friction.Anchored) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy";
equation
  energy = m*(box.v_0*box.v_0)/2 + box.w_a*{I[i]*box.w_a[i] for i in 1:3}/2 + m*world.g*box.r_0[3] + contacts.elasticEnergy;
  connect(box.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=2, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The box strikes the floor with an edge, turns over it, strikes with the next one and comes to rest on a face. Its energy (plot
<code>energy</code>) never rises and ends where half its smallest height above the floor puts it: m g 0.05 m = 1.47 J.
</p>
</html>"));
end BoxOnEdge;
