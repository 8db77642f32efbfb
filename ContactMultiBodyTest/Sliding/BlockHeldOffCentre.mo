within ContactMultiBodyTest.Sliding;
model BlockHeldOffCentre "Two fingers hold a block beside its centre of mass"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Mass m=0.5 "Mass of the block";
  parameter Modelica.Units.SI.Length a=0.04 "Edge of the fingers";
  parameter Modelica.Units.SI.Length width=0.05 "Distance of the fingers";
  parameter Real mu(unit="1")=0.5 "Coefficient of friction";
  parameter Real K(unit="N/m")=1e6 "Stiffness";
  parameter Real share(unit="1")=1.05 "Share of the least force that holds the block";
  final parameter Modelica.Units.SI.Force least=m*world.g/(2*0.7592316*mu) "Least force that holds the block";
  final parameter Modelica.Units.SI.Length pressed=share*least/K "Depth at which the fingers press";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body held(
    m=m,
    r_CM={a/2,0,0},
    I_11=1e-3,
    I_22=2e-3,
    I_33=2e-3,
    geometry=ContactMultiBody.Shapes.box({5*a,width,3*a}),
    r_0(each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Fixed left(r={0,-(width + a)/2 + pressed,0}, geometry=ContactMultiBody.Shapes.box({a,a,a}), animation=false);
  Modelica.Mechanics.MultiBody.Joints.Prismatic guide(n={0,1,0}, s(start=(width + a)/2 - pressed, fixed=true), v(fixed=true), animation=false);
  ContactMultiBody.Parts.Body right(
    m=0.2,
    r_CM={0,0,0},
    I_11=1e-4,
    I_22=1e-4,
    I_33=1e-4,
    geometry=ContactMultiBody.Shapes.box({a,a,a}),
    animation=false);
  Modelica.Mechanics.MultiBody.Forces.WorldForce squeeze(animation=false);
  ContactMultiBody.ContactManager contacts(
    n=3,
    geometry={held.geometry,left.geometry,right.geometry},
    material={held.material,left.material,right.material},
    pairs={{1,2},{1,3}},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness=fill(K, 2),
    muDynamic=fill(mu, 2),
    muStatic=fill(mu, 2),
    friction=ContactMultiBody.Types.Friction.Anchored,
    useRestitution=false);
equation
  connect(world.frame_b, guide.frame_a);
  connect(guide.frame_b, right.frame_a);
  connect(right.frame_a, squeeze.frame_b);
  connect(held.frame_a, contacts.frame[1]);
  connect(left.frame_b, contacts.frame[2]);
  connect(right.frame_a, contacts.frame[3]);
  squeeze.force = {0,-share*least,0};
  annotation (experiment(StopTime=0.5, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
The weight acts at the edge of the square fingers, and turns the block as it pulls it down. Each finger holds by its four corners; the least force is found as that which moves a
<a href=\"modelica://ContactMultiBodyTest.Sliding.PlatePushedAtCorner\">plate pushed at its corner</a>.
</p>
</html>"));
end BlockHeldOffCentre;
