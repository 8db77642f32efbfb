within ContactMultiBodyTest.Impacts;
model FreeVolumeImpact "A box meets a floor flat, without gravity, by the volume law"
  extends Modelica.Icons.Example;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  parameter ContactMultiBody.Types.RestitutionMethod restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless
    "How the speed at the start of the contact is known" annotation (Evaluate=true);
  final parameter Modelica.Units.SI.Mass m=0.5 "Mass of the box";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.1,0.1} "Size of the box";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={0,0,size[3]/2 + 1e-3}, each fixed=true),
    v_0(start={0,0,-1}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.VolumeContactManager contacts(
    n=2,
    geometry={box.geometry,floor.geometry},
    material={box.material,floor.material},
    inertia={box.inertia,floor.inertia},
    friction=ContactMultiBody.Types.Friction.None,
    restitutionMethod=restitutionMethod,
    foundationModulus={1e8});
  Real delivered(unit="1") "Speed after the impact by the speed before it";
equation
  delivered = box.v_0[3];
  connect(box.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.1, Tolerance=1e-6), Documentation(info="<html>
<p>The damping factor delivers its restitution whatever the elastic force, a volume's too.</p>
</html>"));
end FreeVolumeImpact;
