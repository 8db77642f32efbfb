within ContactMultiBody.Examples;
model SlidingBlock "A block slides over a floor until friction has used up its energy"
  extends Modelica.Icons.Example;
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  parameter Modelica.Units.SI.Velocity v0=2 "Speed at the start";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.2,0.05} "Size of the block";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the block";
  final parameter Real K(unit="N/m")=1e6 "Stiffness";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody slider(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=Shapes.box(size),
    material=Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start={0,0,size[3]/2 - m*world.g/K}, each fixed=true),
    v_0(start={v0,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.05) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.3, muStatic=mu))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={slider.geometry,floor.geometry},
    material={slider.material,floor.material},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K},
    friction=Types.Friction.Anchored) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(slider.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=1.5, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The block stops after v<sub>0</sub><sup>2</sup>/(2 mu g) = 0.679579 m, at t = v<sub>0</sub>/(mu g) = 0.6796 s, and then stays where it is:
plot <code>slider.r_0[1]</code>.
</p>
</html>"));
end SlidingBlock;
