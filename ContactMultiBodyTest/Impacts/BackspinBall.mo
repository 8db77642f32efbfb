within ContactMultiBodyTest.Impacts;
model BackspinBall "A ball with backspin bounces obliquely, without events"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Mass m=1 "Mass of the ball";
  final parameter Modelica.Units.SI.Radius R=0.1 "Radius of the ball";
  final parameter Modelica.Units.SI.MomentOfInertia I=0.4*m*R^2 "Moment of inertia of the ball";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body ball(
    m=m,
    r_CM={0,0,0},
    I_11=I,
    I_22=I,
    I_33=I,
    geometry=ContactMultiBody.Shapes.sphere(R),
    material=ContactMultiBody.Materials.Material(restitution=0.8),
    r_0(start={0,0,1}, each fixed=true),
    v_0(start={3,0,0}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={0,-20,0},
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.8));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={ball.geometry,floor.geometry},
    material={ball.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e6},
    muDynamic={0.5},
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless,
    inertia={ball.inertia,floor.inertia});
  Modelica.Units.SI.AngularVelocity spin "Angular velocity about the horizontal axis";
  Modelica.Units.SI.Energy energy "Kinetic, potential and elastic energy";
equation
  spin = ball.w_a[2];
  energy = m*(ball.v_0*ball.v_0)/2 + I*(ball.w_a*ball.w_a)/2 + m*world.g*ball.r_0[3] + contacts.elasticEnergy;
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=3, Tolerance=1e-6, Interval=0.002), Documentation(info="<html>
<p>
The first bounce lasts long enough for friction to turn sliding into rolling: the angular momentum about the point of contact, m R v + I w,
gives the spin (3*0.1 - 0.4*0.01*20)/(1.4*0.01) = 15.7 rad/s, which nothing changes in flight.
</p>
</html>"));
end BackspinBall;
