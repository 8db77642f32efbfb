within ContactMultiBodyTest.Sliding;
model RollingSphere "A sliding sphere starts to roll"
  extends Modelica.Icons.Example;
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  parameter Modelica.Units.SI.Velocity speed=2 "Speed at the start";
  final parameter Modelica.Units.SI.Radius radius=0.1 "Radius of the sphere";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the sphere";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contact";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body sphere(
    m=m,
    r_CM={0,0,0},
    I_11=2/5*m*radius^2,
    I_22=2/5*m*radius^2,
    I_33=2/5*m*radius^2,
    geometry=ContactMultiBody.Shapes.sphere(radius),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start={0,0,radius - m*world.g/K}, each fixed=true),
    v_0(start={speed,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={sphere.geometry,floor.geometry},
    material={sphere.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K});
  Modelica.Units.SI.Velocity slip "Speed of the point of contact";
equation
  slip = sphere.v_0[1] - radius*sphere.w_a[2];
  connect(sphere.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-8, Interval=0.002), Documentation(info="<html>
<p>It rolls from 2 v0/(7 mu g) on, with 5/7 of its speed, whatever the friction.</p>
</html>"));
end RollingSphere;
