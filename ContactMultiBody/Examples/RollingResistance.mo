within ContactMultiBody.Examples;
model RollingResistance "A rolling sphere is stopped by rolling friction"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Velocity v0=0.5 "Speed at the start, rolling";
  final parameter Modelica.Units.SI.Length lever=0.002 "Coefficient of rolling friction";
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
    material=Materials.Material(restitution=0.3, muStatic=0.5),
    r_0(start={0,0,radius - m*world.g/K}, each fixed=true),
    v_0(start={v0,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,v0/radius,0},
    sphereDiameter=0.2) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.3, muStatic=0.5))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={sphere.geometry,floor.geometry},
    material={sphere.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K},
    friction=Types.Friction.Anchored,
    useTurningFriction=true,
    rollingLever={lever}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(sphere.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=5, Tolerance=1e-8, Interval=0.005),
    Documentation(info="<html>
<p>
The torque f m g slows the rolling sphere by a = 5 f g/(7 r) = 0.14014 m/s<sup>2</sup>; it stands after
v<sub>0</sub>/a = 3.5678 s and v<sub>0</sub><sup>2</sup>/(2 a) = 0.89195 m: plot <code>sphere.r_0[1]</code>.
</p>
</html>"));
end RollingResistance;
