within ContactMultiBodyTest.Impacts;
model RestitutionWithoutEvents "A free impact delivers exactly the restitution asked for, without an event"
  extends Modelica.Icons.Example;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.Body ball(
    m=0.5,
    r_CM={0,0,0},
    I_11=0.002,
    I_22=0.002,
    I_33=0.002,
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={0,0,0.2}, each fixed=true),
    v_0(start={0,0,-3}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.PureModelica.SphereOnHalfSpace contact(
    radius=0.1,
    material={ball.material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless,
    inertia={ball.inertia,floor.inertia});
  Real delivered "Speed after the impact by the speed before it";
equation
  delivered = ball.v_0[3]/3;
  connect(ball.frame_a, contact.frame[1]);
  connect(floor.frame_a, contact.frame[2]);
  annotation (experiment(StopTime=0.3, Tolerance=1e-8), Documentation(info="<html>
<p>Whatever parameter e is, <code>delivered</code> ends at it; there are no discrete variables.</p>
</html>"));
end RestitutionWithoutEvents;
