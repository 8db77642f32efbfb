within ContactMultiBodyTest.Rest;
model RestingBox "A box is set down and stays"
  extends Modelica.Icons.Example;
  parameter Real mu(min=0, unit="1")=0.5 "Coefficient of friction";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.3,0.1} "Size of the box";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the box";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contact";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start={0,0,size[3]/2 + 0.001}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={box.geometry,floor.geometry},
    material={box.material,floor.material},
    friction=ContactMultiBody.Types.Friction.Anchored,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K});
equation
  connect(box.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=60, Tolerance=1e-8, Interval=0.05), Documentation(info="<html>
<p>Dropped from 1 mm it comes to rest at the depth m g/K and drifts nowhere in a minute.</p>
</html>"));
end RestingBox;
