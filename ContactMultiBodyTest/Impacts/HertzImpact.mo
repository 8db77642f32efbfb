within ContactMultiBodyTest.Impacts;
model HertzImpact "An elastic impact of Hertz's spring has the greatest depth and the energy of the closed form"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.Body ball(
    m=0.5,
    r_CM={0,0,0},
    I_11=0.002,
    I_22=0.002,
    I_33=0.002,
    material=ContactMultiBody.Materials.Rubber(restitution=1),
    r_0(start={0,0,0.101}, each fixed=true),
    v_0(start={0,0,-1}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Steel(restitution=1));
  ContactMultiBody.PureModelica.SphereOnHalfSpace contact(
    radius=0.1,
    contactRadius={0.1},
    material={ball.material,floor.material},
    friction=ContactMultiBody.Types.Friction.None);
  Modelica.Units.SI.Energy energy "Kinetic and elastic energy";
equation
  energy = ball.m*(ball.v_0*ball.v_0)/2 + contact.elasticEnergy;
  connect(ball.frame_a, contact.frame[1]);
  connect(floor.frame_a, contact.frame[2]);
  annotation (experiment(StopTime=0.02, Tolerance=1e-9), Documentation(info="<html>
<p>The greatest depth is (5 m v<sup>2</sup>/(4 K))<sup>2/5</sup>; <code>energy</code> is constant.</p>
</html>"));
end HertzImpact;
