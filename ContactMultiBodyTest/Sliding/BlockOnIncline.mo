within ContactMultiBodyTest.Sliding;
model BlockOnIncline "A block on an incline sticks or slides"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Angle angle=Modelica.Units.Conversions.from_deg(17.4) "Angle of the incline" annotation (Evaluate=true);
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.2,0.1} "Size of the block";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the block";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contact";
  final parameter Real normal[3](each unit="1")={sin(angle),0,cos(angle)} "Normal of the incline";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=ContactMultiBody.Shapes.box(size),
    material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start=(size[3]/2 - m*world.g*cos(angle)/K)*normal, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={0,angle,0},
    w_0_fixed=true,
    animation=false);
  ContactMultiBody.Parts.Ground incline(normal=normal, material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=mu));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={box.geometry,incline.geometry},
    material={box.material,incline.material},
    friction=ContactMultiBody.Types.Friction.Anchored,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={K});
  Modelica.Units.SI.Distance s "Way down the incline";
  Modelica.Units.SI.Velocity v "Speed down the incline";
  Modelica.Units.SI.Acceleration a "Acceleration down the incline";
equation
  s = box.r_0*{cos(angle),0,-sin(angle)};
  v = box.v_0*{cos(angle),0,-sin(angle)};
  a = box.a_0*{cos(angle),0,-sin(angle)};
  connect(box.frame_a, contacts.frame[1]);
  connect(incline.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=2, Tolerance=1e-8, Interval=0.005), Documentation(info="<html>
<p>It sticks if tan(angle) is less than mu; else it slides with g (sin(angle) - mu cos(angle)).</p>
</html>"));
end BlockOnIncline;
