within ContactMultiBody.Examples;
model RollingSphere "A sphere that slides first ends up rolling"
  extends Modelica.Icons.Example;
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  parameter Modelica.Units.SI.Velocity v0=2 "Speed at the start, without turning";
  final parameter Modelica.Units.SI.Radius radius=0.1 "Radius of the sphere";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the sphere";
  final parameter Real K(unit="N/m")=1e6 "Stiffness";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody sphere(
    m=m,
    r_CM={0,0,0},
    I_11=0.4*m*radius^2,
    I_22=0.4*m*radius^2,
    I_33=0.4*m*radius^2,
    geometry=Shapes.sphere(radius),
    material=Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start={0,0,radius - m*world.g/K}, each fixed=true),
    v_0(start={v0,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.2) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.3, muStatic=mu))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={sphere.geometry,floor.geometry},
    material={sphere.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(sphere.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=1, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
Friction slows the sphere down and turns it until it rolls, at t = 2 v<sub>0</sub>/(7 mu g) = 0.194165 s and x = 0.332855 m, with 5/7 of its speed: plot
<code>sphere.v_0[1]</code> and <code>sphere.w_a[2]*0.1</code>.
</p>
</html>"));
end RollingSphere;
