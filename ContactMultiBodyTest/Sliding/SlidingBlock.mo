within ContactMultiBodyTest.Sliding;
model SlidingBlock "A block slides to rest on a level floor"
  extends Modelica.Icons.Example;
  parameter ContactMultiBody.Types.Friction friction=ContactMultiBody.Types.Friction.Regularised "Law of friction"
    annotation (Evaluate=true);
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  parameter Modelica.Units.SI.Velocity speed=2 "Speed at the start";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.2,0.1} "Size of the block";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the block";
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
    r_0(start={0,0,size[3]/2 - m*world.g/K}, each fixed=true),
    v_0(start={speed,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={box.geometry,floor.geometry},
    material={box.material,floor.material},
    friction=friction,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K});
equation
  connect(box.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=2, Tolerance=1e-8, Interval=0.002), Documentation(info="<html>
<p>It comes to rest after v0^2/(2 mu g).</p>
</html>"));
end SlidingBlock;
