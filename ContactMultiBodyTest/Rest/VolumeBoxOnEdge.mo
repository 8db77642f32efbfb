within ContactMultiBodyTest.Rest;
model VolumeBoxOnEdge "A box is dropped on its edge and ends flat, by the volume law"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Length size[3]={0.3,0.2,0.1} "Size of the box";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the box";
  final parameter Real k(unit="N/m3")=5e7 "Pressure by depth";
  parameter Modelica.Units.SI.Angle angles[3]={0,0.5,0} "Rotation about x, then y, then z at the start";
  final parameter Real mu=0.4 "Coefficient of friction";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start={0,0,0.2}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start=angles,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu));
  ContactMultiBody.VolumeContactManager contacts(
    n=2,
    geometry={box.geometry,floor.geometry},
    material={box.material,floor.material},
    foundationModulus={k});
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy";
equation
  energy = m*(box.v_0*box.v_0)/2 + box.w_a*(box.I*box.w_a)/2 + m*world.g*box.r_0[3] + contacts.elasticEnergy;
  connect(box.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=3, Tolerance=1e-8, Interval=0.002), Documentation(info="<html>
<p>Nothing adds energy, so it never rises. In the end the box lies flat at the depth m g/(k A).</p>
</html>"));
end VolumeBoxOnEdge;
