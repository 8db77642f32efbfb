within ContactMultiBodyTest.Rest;
model RockingEllipsoid "An ellipsoid rolls to and fro about its flat side"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Length axes[3]={0.4,0.3,0.2} "Full lengths of the axes";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the ellipsoid";
  final parameter Modelica.Units.SI.Angle tilt=0.02 "Tilt at the start";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e7 "Stiffness of the contact";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body body(
    m=m,
    r_CM={0,0,0},
    I_11=m*(axes[2]^2 + axes[3]^2)/20,
    I_22=m*(axes[1]^2 + axes[3]^2)/20,
    I_33=m*(axes[1]^2 + axes[2]^2)/20,
    geometry=ContactMultiBody.Shapes.ellipsoid(axes),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=1),
    r_0(start={0,0,sqrt((axes[1]*sin(tilt))^2 + (axes[3]*cos(tilt))^2)/2 - m*world.g/K}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={0,tilt,0},
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=1));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={body.geometry,floor.geometry},
    material={body.material,floor.material},
    pointCapacity=1,
    regularisationSpeed=1e-5,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K});
  Real slope(unit="1") "Sine of the tilt";
equation
  slope = -body.frame_a.R.T[1, 3];
  connect(body.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=2, Tolerance=1e-6, Interval=0.002), Documentation(info="<html>
<p>
Small oscillations of rolling without slip: w<sup>2</sup> = m g (R - c)/(I + m c<sup>2</sup>) with the half axes a and c, the radius of curvature R = a<sup>2</sup>/c at
the bottom, and I = m (a<sup>2</sup> + c<sup>2</sup>)/5.
</p>
</html>"));
end RockingEllipsoid;
