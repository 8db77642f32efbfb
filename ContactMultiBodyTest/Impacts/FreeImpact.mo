within ContactMultiBodyTest.Impacts;
model FreeImpact "A ball meets a floor without gravity"
  extends Modelica.Icons.Example;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  parameter Modelica.Units.SI.Velocity speed(min=Modelica.Constants.small)=1 "Speed of the ball";
  parameter Real stiffness(min=0)=1e6 "Stiffness of the contact in N/m^exponent";
  parameter Real exponent(min=1, unit="1")=1.5 "Exponent of the depth";
  parameter ContactMultiBody.Types.RestitutionMethod restitutionMethod=ContactMultiBody.Types.RestitutionMethod.ImpactSpeed
    "How the speed at the start of the contact is known" annotation (Evaluate=true);
  final parameter Modelica.Units.SI.Mass m=0.5 "Mass of the ball";
  final parameter Modelica.Units.SI.Radius radius=0.1 "Radius of the ball";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body ball(
    m=m,
    r_CM={0,0,0},
    I_11=2/5*m*radius^2,
    I_22=2/5*m*radius^2,
    I_33=2/5*m*radius^2,
    geometry=ContactMultiBody.Shapes.sphere(radius),
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={0,0,radius + 1e-3*speed}, each fixed=true),
    v_0(start={0,0,-speed}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={ball.geometry,floor.geometry},
    material={ball.material,floor.material},
    inertia={ball.inertia,floor.inertia},
    pointCapacity=1,
    friction=ContactMultiBody.Types.Friction.None,
    restitutionMethod=restitutionMethod,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    exponent=exponent,
    stiffness={stiffness});
  Real delivered(unit="1") "Speed after the impact by the speed before it";
equation
  delivered = ball.v_0[3]/speed;
  connect(ball.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.1, Tolerance=1e-6), Documentation(info="<html>
<p>After the impact <code>delivered</code> is e, whatever speed, stiffness and exponent are. The ball touches after 1 ms.</p>
</html>"));
end FreeImpact;
