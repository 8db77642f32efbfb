within ContactMultiBody.Examples;
model SpinningSphere "A sphere that spins on the spot is stopped by the friction of its area of contact"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.AngularVelocity w0=10 "Angular velocity at the start";
  final parameter Modelica.Units.SI.Radius radius=0.05 "Radius of the sphere";
  final parameter Modelica.Units.SI.Radius area=0.005 "Radius of the area of contact";
  final parameter Modelica.Units.SI.Mass m=0.5 "Mass of the sphere";
  final parameter Real K(unit="N/m")=1e6 "Stiffness";
  final parameter Modelica.Units.SI.Time stop=0.4*m*radius^2*w0/(2/3*0.3*m*world.g*area) "Time after which the sphere stands";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody sphere(
    m=m,
    r_CM={0,0,0},
    I_11=0.4*m*radius^2,
    I_22=0.4*m*radius^2,
    I_33=0.4*m*radius^2,
    geometry=Shapes.sphere(radius),
    material=Materials.Material(restitution=0.3, muStatic=0.3),
    r_0(start={0,0,radius - m*world.g/K}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,0,w0},
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.3, muStatic=0.3))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={sphere.geometry,floor.geometry},
    material={sphere.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K},
    useTurningFriction=true,
    spinRadius={area}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(sphere.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=2, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The torque 2/3 mu m g a slows the sphere evenly; it stands after J w<sub>0</sub>/(2/3 mu m g a) = 1.0194 s: plot <code>sphere.w_a[3]</code>.
</p>
</html>"));
end SpinningSphere;
