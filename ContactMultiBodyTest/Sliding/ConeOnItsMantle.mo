within ContactMultiBodyTest.Sliding;
model ConeOnItsMantle "A cone lies on its mantle on an inclined box, and rolls to and fro about its tip"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Radius r=0.05 "Radius of the base";
  final parameter Modelica.Units.SI.Length h=0.12 "Height";
  final parameter Modelica.Units.SI.Mass m=0.3 "Mass of the cone";
  final parameter Modelica.Units.SI.Angle alpha=atan(r/h) "Half-angle of the cone";
  final parameter Modelica.Units.SI.Angle beta=0.15 "Inclination of the box";
  final parameter Modelica.Units.SI.Angle start=0.5 "Between the line of contact and the line of steepest descent, at the start";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body cone(
    m=m,
    r_CM={0,0,0},
    I_11=m*(12*r^2 + 3*h^2)/80,
    I_22=m*(12*r^2 + 3*h^2)/80,
    I_33=0.3*m*r^2,
    geometry=ContactMultiBody.Shapes.cone(r, h, position={0,0,h/4}),
    material=ContactMultiBody.Materials.Material(muStatic=1, muDynamic=1),
    r_0(start=-0.75*h*toTip, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={atan2(-toTip[2], toTip[3]),asin(toTip[1]),0},
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground ramp(
    geometry=ContactMultiBody.Shapes.box({1,1,0.2}, position=-0.1*up, rotation={{cos(beta),0,-sin(beta)},{0,1,0},{sin(beta),0,cos(beta)}}),
    material=ContactMultiBody.Materials.Material(muStatic=1, muDynamic=1));
  ContactMultiBody.ContactManager contacts(
    n=2,
    collider={cone.collider,ramp.collider},
    regularisationSpeed=1e-4,
    useRestitution=false,
    steadyRate={5},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e6});
  Modelica.Units.SI.Position aside "Of the centre of mass, from the plane of steepest descent";
  Modelica.Units.SI.Energy energy "Kinetic and potential, and of the springs";
protected
  final parameter Real up[3]={sin(beta),0,cos(beta)} "Normal of the box";
  final parameter Real along[3]=cos(start)*{cos(beta),0,-sin(beta)} + {0,sin(start),0} "From the tip along the line of contact";
  final parameter Real toTip[3]=-cos(alpha)*along - sin(alpha)*up "From the base to the tip";
equation
  aside = cone.frame_a.r_0[2];
  energy = m*(cone.v_0*cone.v_0/2 + world.g*cone.r_0[3]) + cone.w_a*(cone.I*cone.w_a)/2 + contacts.elasticEnergy;
  connect(cone.frame_a, contacts.frame[1]);
  connect(ramp.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=2, Tolerance=1e-6, Interval=0.002), Documentation(info="<html>
<p>
Without slip the tip stays where it is, and the cone turns about its line of contact: kinetic energy 3/40 m h<sup>2</sup> (1 + 5 cos(alpha)<sup>2</sup>) by the square of the
rate at which that line turns (Landau and Lifshitz, Mechanics, section 32, problem 7), potential energy -3/4 m g h cos(alpha) sin(beta) by the cosine of the angle: a pendulum.
At the start it touches all along its line. Damping of the normal force resists rolling, so there is little of it.
</p>
</html>"));
end ConeOnItsMantle;
