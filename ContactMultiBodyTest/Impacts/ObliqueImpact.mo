within ContactMultiBodyTest.Impacts;
model ObliqueImpact "A collision in free space changes neither momentum nor angular momentum"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity);
  ContactMultiBody.Parts.Body a(
    m=1,
    r_CM={0,0,0},
    I_11=0.004,
    I_22=0.004,
    I_33=0.004,
    r_0(start={-0.3,0.04,0}, each fixed=true),
    v_0(start={2,0,0.1}, each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    w_0_start={1,20,-5});
  ContactMultiBody.Parts.Body b(
    m=2,
    r_CM={0,0,0},
    I_11=0.008,
    I_22=0.008,
    I_33=0.008,
    r_0(start={0.1,0,0.03}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true);
  ContactMultiBody.PureModelica.SphereOnSphere contact(
    radius1=0.1,
    radius2=0.12,
    material={a.material,b.material},
    useTurningFriction=true,
    spinRadius={0.01},
    rollingLever={0.001});
  Modelica.Units.SI.Momentum momentum[3] "Momentum of both bodies";
  Modelica.Units.SI.AngularMomentum angularMomentum[3] "Angular momentum of both bodies about the origin";
equation
  momentum = a.m*a.v_0 + b.m*b.v_0;
  angularMomentum = a.m*cross(a.r_0, a.v_0) + b.m*cross(b.r_0, b.v_0) + 0.004*Modelica.Mechanics.MultiBody.Frames.resolve1(
    a.frame_a.R, a.w_a) + 0.008*Modelica.Mechanics.MultiBody.Frames.resolve1(b.frame_a.R, b.w_a);
  connect(a.frame_a, contact.frame[1]);
  connect(b.frame_a, contact.frame[2]);
  annotation (experiment(StopTime=0.5, Tolerance=1e-9), Documentation(info="<html>
<p>Two spheres meet off centre, with friction and spin; <code>momentum</code> and <code>angularMomentum</code> are constant.</p>
</html>"));
end ObliqueImpact;
