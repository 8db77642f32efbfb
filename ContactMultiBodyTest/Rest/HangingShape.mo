within ContactMultiBodyTest.Rest;
model HangingShape "A CollisionShape on a frame inside a mechanism of the Standard Library strikes a wall"
  extends Modelica.Icons.Example;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  final parameter Modelica.Units.SI.Length l=0.5 "Length of the pendulum";
  final parameter Modelica.Units.SI.Mass m=2 "Mass at its end";
  final parameter Modelica.Units.SI.Inertia I=0.01 "Inertia about the centre of mass";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  Modelica.Mechanics.MultiBody.Joints.Revolute joint(n={0,1,0}, phi(start=0, fixed=true), w(start=1, fixed=true));
  Modelica.Mechanics.MultiBody.Parts.FixedTranslation arm(r={l,0,0}, animation=false);
  Modelica.Mechanics.MultiBody.Parts.Body body(
    m=m,
    r_CM={0,0,0},
    I_11=I,
    I_22=I,
    I_33=I,
    animation=false);
  ContactMultiBody.Parts.CollisionShape tip(geometry=ContactMultiBody.Shapes.sphere(0.01), material=
        ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.Parts.Ground wall(
    r={0,0,-0.0105},
    material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={tip.geometry,wall.geometry},
    material={tip.material,wall.material},
    pointCapacity=1,
    friction=ContactMultiBody.Types.Friction.None,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e7});
equation
  connect(world.frame_b, joint.frame_a);
  connect(joint.frame_b, arm.frame_a);
  connect(arm.frame_b, body.frame_a);
  connect(arm.frame_b, tip.frame_a);
  connect(tip.frame_a, contacts.frame[1]);
  connect(wall.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.01, Tolerance=1e-6), Documentation(info="<html>
<p>The body, the arm and the joint are those of the Standard Library; the pendulum turns back with e of its speed.</p>
</html>"));
end HangingShape;
