within ContactMultiBodyTest.Sliding;
model SpinningCoin "A thick coin wobbles on its rim on a box, without friction (Euler's disc)"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Radius a=0.0375 "Radius of the coin";
  final parameter Modelica.Units.SI.Length h=0.0128 "Thickness of the coin";
  final parameter Modelica.Units.SI.Mass m=0.44 "Mass of the coin";
  final parameter Modelica.Units.SI.Angle tilt=0.5 "Of the coin to the box";
  final parameter Modelica.Units.SI.Inertia across=m*(3*a^2 + h^2)/12 "About a diameter";
  final parameter Modelica.Units.SI.AngularVelocity rate=sqrt(m*9.81*(a*cos(tilt) - h/2*sin(tilt))/(across*sin(tilt)*cos(tilt))) "Of the place that touches";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body coin(
    m=m,
    r_CM={0,0,0},
    I_11=across,
    I_22=across,
    I_33=m*a^2/2,
    geometry=ContactMultiBody.Shapes.cylinder(a, h),
    r_0(start={0,0,a*sin(tilt) + h/2*cos(tilt)}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={tilt,0,0},
    w_0_fixed=true,
    w_0_start=rate*{0,cos(tilt)*sin(tilt),sin(tilt)^2},
    animation=false);
  ContactMultiBody.Parts.Ground table(geometry=ContactMultiBody.Shapes.box({1,1,0.2}, position={0,0,-0.1}));
  ContactMultiBody.ContactManager contacts(
    n=2,
    collider={coin.collider,table.collider},
    friction=ContactMultiBody.Types.Friction.None,
    useRestitution=false,
    steadyRate={0},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e7});
  Real slope(unit="1") "Of the coin's axis, along y";
equation
  slope = coin.frame_a.R.T[3, 2];
  connect(coin.frame_a, contacts.frame[1]);
  connect(table.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.2, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
A coin that does not turn about its own axis goes round steadily where the moment of its weight, m g (a cos(tilt) - h/2 sin(tilt)), is what the moment of momentum about a diameter
changes by, across*rate<sup>2</sup> sin(tilt) cos(tilt). The centre of mass stands still. Damping of the normal force resists rolling, so there is none.
</p>
</html>"));
end SpinningCoin;
