within ContactMultiBodyTest.Rest;
model HeavyOnLight "A heavy box rests on a light one"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Mass light=1 "Mass of the lower box";
  parameter Modelica.Units.SI.Mass heavy=1000 "Mass of the upper box";
  final parameter Modelica.Units.SI.Length side=0.2 "Edges of both boxes";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e7 "Stiffness of both contacts";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body lower(
    m=light,
    r_CM={0,0,0},
    I_11=light*side^2/6,
    I_22=light*side^2/6,
    I_33=light*side^2/6,
    geometry=ContactMultiBody.Shapes.box({side,side,side}),
    material=ContactMultiBody.Materials.Material(restitution=0.1),
    r_0(start={0,0,side/2}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Body upper(
    m=heavy,
    r_CM={0,0,0},
    I_11=heavy*side^2/6,
    I_22=heavy*side^2/6,
    I_33=heavy*side^2/6,
    geometry=ContactMultiBody.Shapes.box({side,side,side}),
    material=ContactMultiBody.Materials.Material(restitution=0.1),
    r_0(start={0,0,3*side/2}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.1));
  ContactMultiBody.ContactManager contacts(
    n=3,
    geometry={lower.geometry,upper.geometry,floor.geometry},
    material={lower.material,upper.material,floor.material},
    pairs={{1,3},{2,1}},
    friction=ContactMultiBody.Types.Friction.Anchored,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K,K});
equation
  connect(lower.frame_a, contacts.frame[1]);
  connect(upper.frame_a, contacts.frame[2]);
  connect(floor.frame_a, contacts.frame[3]);
  annotation (experiment(StopTime=30, Tolerance=1e-8, Interval=0.02), Documentation(info="<html>
<p>The contacts carry (m1 + m2) g and m2 g, so their depths are these forces by K.</p>
</html>"));
end HeavyOnLight;
