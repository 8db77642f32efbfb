within ContactMultiBodyTest.Impacts;
model SpringDamperImpact "A spring and damper with damping ratio 0.1 deliver 0.744, without pulling"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.Body ball(
    m=0.5,
    r_CM={0,0,0},
    I_11=0.002,
    I_22=0.002,
    I_33=0.002,
    r_0(start={0,0,0.2}, each fixed=true),
    v_0(start={0,0,-3}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.PureModelica.SphereOnHalfSpace contact(
    radius=0.1,
    material={ball.material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=ContactMultiBody.Types.NormalLaw.SpringDamper,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e5},
    damping={2*0.1*sqrt(1e5*ball.m)},
    dampingDepth=1e-8);
  Real delivered "Speed after the impact by the speed before it";
equation
  delivered = ball.v_0[3]/3;
  connect(ball.frame_a, contact.frame[1]);
  connect(floor.frame_a, contact.frame[2]);
  annotation (experiment(StopTime=0.3, Tolerance=1e-8), Documentation(info="<html>
<p>The force of a linear spring and damper falls to zero before the depth does; the impact ends there with the restitution
exp(-D/sqrt(1 - D<sup>2</sup>) (pi - 2 asin(D))), D = 0.1.</p>
</html>"));
end SpringDamperImpact;
