within ContactMultiBodyTest.Rest;
model FallingDomino "A domino tips over and falls flat, without events"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Length size[3]={0.0075,0.024,0.048} "Size of the domino";
  final parameter Modelica.Units.SI.Mass m=0.01 "Mass of the domino";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e5 "Stiffness of the contact";
  final parameter Modelica.Units.SI.AngularVelocity w=6 "Angular velocity at the start";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body domino(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.3),
    r_0(start={0,0,size[3]/2 - m*9.81/K}, each fixed=true),
    v_0(start={w*size[3]/2,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,w,0},
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.3));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={domino.geometry,floor.geometry},
    material={domino.material,floor.material},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K},
    muDynamic={0.3},
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless,
    inertia={domino.inertia,floor.inertia});
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy";
equation
  energy = m*(domino.v_0*domino.v_0)/2 + domino.w_a*(domino.I*domino.w_a)/2 + m*world.g*domino.r_0[3] + contacts.elasticEnergy;
  connect(domino.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.002), Documentation(info="<html>
<p>
While one edge strikes, its springs lever the opposite edge into the floor; in the end the domino lies flat at the depth m g/K.
</p>
</html>"));
end FallingDomino;
