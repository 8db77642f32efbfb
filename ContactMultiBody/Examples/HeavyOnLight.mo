within ContactMultiBody.Examples;
model HeavyOnLight "A body a thousand times heavier rests on a light one"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Length a=0.2 "Edge of the boxes";
  final parameter Modelica.Units.SI.Mass m[2]={1,1000} "Masses, the lower first";
  final parameter Real K(unit="N/m")=1e8 "Stiffness";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody light(
    m=m[1],
    r_CM={0,0,0},
    I_11=m[1]*a^2/6,
    I_22=m[1]*a^2/6,
    I_33=m[1]*a^2/6,
    geometry=Shapes.box({a,a,a}),
    material=Materials.Material(restitution=0.2),
    r_0(start={0,0,a/2}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,10},{-20,30}})));
  Parts.FreeBody heavy(
    m=m[2],
    r_CM={0,0,0},
    I_11=m[2]*a^2/6,
    I_22=m[2]*a^2/6,
    I_33=m[2]*a^2/6,
    geometry=Shapes.box({a,a,a}),
    material=Materials.Material(restitution=0.2),
    r_0(start={0,0,3*a/2}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,40},{-20,60}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.2))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=3,
    geometry={light.geometry,heavy.geometry,floor.geometry},
    material={light.material,heavy.material,floor.material},
    pairs={{1,3},{2,1}},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K,K},
    friction=Types.Friction.Anchored) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(light.frame_a, contacts.frame[1]) annotation (Line(points={{-40,20},{-60,20},{-60,0},{20,0}}, color={95,95,95}));
  connect(heavy.frame_a, contacts.frame[2]) annotation (Line(points={{-40,50},{-60,50},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[3]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=2, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The light box comes to rest at a depth of (m<sub>1</sub> + m<sub>2</sub>) g/K = 0.0982 mm, the heavy one m<sub>2</sub> g/K = 0.0981 mm deeper: plot
<code>contacts.distance</code>. Impulse-based solvers are known to let such stacks sink or collapse.
</p>
</html>"));
end HeavyOnLight;
