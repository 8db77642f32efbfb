within ContactMultiBodyTest.Impacts;
model PainleveRod "A rod slides on its end with so much friction that it jams"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the rod";
  final parameter Modelica.Units.SI.Length length=1 "Length between the centres of its round ends";
  parameter Modelica.Units.SI.Radius radius=0.002 "Radius of its ends";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contact";
  parameter Modelica.Units.SI.Velocity speed(min=0)=10 "Speed at the start";
  parameter Modelica.Units.SI.Angle slope=1.107149 "Between rod and floor";
  final parameter Modelica.Units.SI.MomentOfInertia I=m*length^2/12 "Moment of inertia across the rod";
  final parameter Modelica.Units.SI.MomentOfInertia I_axis=m*radius^2/2 "Moment of inertia about its axis";
  parameter Real mu(min=0, unit="1")=1.6 "Coefficient of friction";
  parameter Real e(min=0, max=1, unit="1")=0.3 "Coefficient of restitution";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body rod(
    m=m,
    r_CM={0,0,0},
    I_11=I,
    I_22=I,
    I_33=I_axis,
    geometry=ContactMultiBody.Shapes.capsule(radius, length),
    r_0(start={length/2*cos(slope),0,length/2*sin(slope) + radius - m*9.81/4/K}, each fixed=true),
    v_0(start={-speed,0,0}, each fixed=true),
    angles_fixed=true,
    angles_start={0,Modelica.Constants.pi/2 - slope,0},
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={rod.geometry,floor.geometry},
    material={rod.material,floor.material},
    pointCapacity=2,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K},
    muDynamic={mu},
    muStatic={mu},
    restitution={e},
    inertia={rod.inertia,floor.inertia});
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy";
equation
  energy = m*(rod.v_0*rod.v_0)/2 + I*(rod.w_a[1]^2 + rod.w_a[2]^2)/2 + I_axis*rod.w_a[3]^2/2 + m*world.g*rod.r_0[3] + contacts.elasticEnergy;
  connect(rod.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
Beyond &mu; = 4/3 a rigid rod at this slope has no consistent acceleration (P. Painlev&eacute; 1895): friction turns it into the floor. A compliant contact
jams within its compliance and throws the rod off. Friction and damping only take energy.
</p>
</html>"));
end PainleveRod;
