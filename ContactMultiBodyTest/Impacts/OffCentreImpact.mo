within ContactMultiBodyTest.Impacts;
model OffCentreImpact "The end of a rod strikes a ball, both free"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Types.RestitutionMethod;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  parameter RestitutionMethod restitutionMethod=RestitutionMethod.ImpactSpeed "How the speed at the start of the contact is known"
    annotation (Evaluate=true);
  final parameter Modelica.Units.SI.Length l=0.3 "From the middle of the rod to its end";
  final parameter Modelica.Units.SI.Radius radius=0.02 "Radius of the rod's end and of the ball";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the rod";
  final parameter Modelica.Units.SI.Mass mBall=0.3 "Mass of the ball";
  final parameter Modelica.Units.SI.Velocity speed=1 "Speed of the rod";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body rod(
    m=m,
    r_CM={0.1,0,0},
    I_11=1e-3,
    I_22=m*l^2/3,
    I_33=m*l^2/3,
    geometry=ContactMultiBody.Shapes.sphere(radius, {0.1 + l,0,0}),
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={-0.1 - l,0,2*radius + 1e-3}, each fixed=true),
    v_0(start={0,0,-speed}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Body ball(
    m=mBall,
    r_CM={0,0,0},
    I_11=2/5*mBall*radius^2,
    I_22=2/5*mBall*radius^2,
    I_33=2/5*mBall*radius^2,
    geometry=ContactMultiBody.Shapes.sphere(radius),
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={rod.geometry,ball.geometry},
    material={rod.material,ball.material},
    inertia={rod.inertia,ball.inertia},
    pointCapacity=1,
    friction=ContactMultiBody.Types.Friction.None,
    restitutionMethod=restitutionMethod,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e9});
  Real delivered(unit="1") "Speed of separation by speed of approach";
  Modelica.Units.SI.Impulse impulse "What the ball got";
  Modelica.Units.SI.Impulse known=(1 + e)*speed/(1/m + l^2/(m*l^2/3) + 1/mBall) "What rigid bodies would give it";
equation
  delivered = ContactMultiBody.Internal.Unaliased.scalar(-contacts.approachSpeed[1]/speed);
  impulse = -mBall*ball.v_0[3];
  connect(rod.frame_a, contacts.frame[1]);
  connect(ball.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.0015, Tolerance=1e-6), Documentation(info="<html>
<p>
The effective mass is 1/(1/m + l<sup>2</sup>/I + 1/m<sub>ball</sub>), far from the masses. <code>delivered</code> ends at e and <code>impulse</code> at <code>known</code>.
</p>
</html>"));
end OffCentreImpact;
