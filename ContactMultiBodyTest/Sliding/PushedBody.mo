within ContactMultiBodyTest.Sliding;
partial model PushedBody "A plate on a floor and a force that pushes it"
  parameter Modelica.Units.SI.Mass m=1 "Mass of the plate";
  parameter Modelica.Units.SI.Length a=0.2 "Edge of the plate";
  parameter Modelica.Units.SI.Length height=0.02 "Height of the plate";
  parameter Real mu(unit="1")=0.3 "Coefficient of friction";
  parameter Real K(unit="N/m")=1e6 "Stiffness";
  final parameter Modelica.Units.SI.Length settled=m*world.g/K "Depth at which the floor carries the plate";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body plate(
    m=m,
    r_CM={0,0,0},
    I_11=m*(a^2 + height^2)/12,
    I_22=m*(a^2 + height^2)/12,
    I_33=m*a^2/6,
    geometry=ContactMultiBody.Shapes.box({a,a,height}),
    r_0(start={0,0,height/2 - settled}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={plate.geometry,floor.geometry},
    material={plate.material,floor.material},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K},
    muDynamic={mu},
    muStatic={mu},
    friction=ContactMultiBody.Types.Friction.Anchored,
    useRestitution=false);
  Modelica.Mechanics.MultiBody.Parts.FixedTranslation grip(animation=false) "From the middle of the plate to where it is pushed";
  Modelica.Mechanics.MultiBody.Forces.WorldForce push(animation=false);
equation
  connect(plate.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  connect(plate.frame_a, grip.frame_a);
  connect(grip.frame_b, push.frame_b);
  annotation (Documentation(info="<html>
<p>A square plate that lies on its four corners, each of which carries a fourth of its weight.</p>
</html>"));
end PushedBody;
