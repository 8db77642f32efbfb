within ContactMultiBody.Examples;
model HammerOnAnvil "A hammer on a double pendulum strikes an anvil and bounces"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-20},{-80,0}})));
  Modelica.Mechanics.MultiBody.Joints.Revolute shoulder(
    n={0,1,0},
    phi(start=-0.6, fixed=true),
    w(fixed=true)) annotation (Placement(transformation(extent={{-70,-20},{-50,0}})));
  Modelica.Mechanics.MultiBody.Parts.BodyShape arm(
    r={0.3,0,0},
    r_CM={0.15,0,0},
    m=0.5,
    I_11=1e-4,
    I_22=4e-3,
    I_33=4e-3) annotation (Placement(transformation(extent={{-40,-20},{-20,0}})));
  Modelica.Mechanics.MultiBody.Joints.Revolute wrist(
    n={0,1,0},
    phi(start=0.2, fixed=true),
    w(fixed=true)) annotation (Placement(transformation(extent={{-10,-20},{10,0}})));
  Parts.BodyShape hammer(
    r={0.3,0,0},
    r_CM={0.27,0,0},
    m=1.2,
    I_11=1e-3,
    I_22=4e-3,
    I_33=4e-3,
    geometry=Shapes.compound({Shapes.capsule(0.01, 0.26, {0.13,0,0}, [0,0,-1; 0,1,0; 1,0,0]),Shapes.box({0.04,0.04,0.12}, {0.28,0,0})}),
    material=Materials.Material(restitution=0.5, muStatic=0.2))
    annotation (Placement(transformation(extent={{20,-20},{40,0}})));
  Parts.Ground anvil(
    r={0.57,0,-0.12},
    geometry=Shapes.box({0.2,0.12,0.1}),
    material=Materials.Material(restitution=0.5, muStatic=0.2))
    annotation (Placement(transformation(extent={{20,-80},{40,-60}})));
  ContactManager contacts(
    n=2,
    geometry={hammer.geometry,anvil.geometry},
    material={hammer.material,anvil.material},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={1e6}) annotation (Placement(transformation(extent={{60,-60},{100,-20}})));
equation
  connect(world.frame_b, shoulder.frame_a) annotation (Line(points={{-80,-10},{-70,-10}}, color={95,95,95}));
  connect(shoulder.frame_b, arm.frame_a) annotation (Line(points={{-50,-10},{-40,-10}}, color={95,95,95}));
  connect(arm.frame_b, wrist.frame_a) annotation (Line(points={{-20,-10},{-10,-10}}, color={95,95,95}));
  connect(wrist.frame_b, hammer.frame_a) annotation (Line(points={{10,-10},{20,-10}}, color={95,95,95}));
  connect(hammer.frame_a, contacts.frame[1]) annotation (Line(points={{20,-10},{14,-10},{14,-40},{60,-40}}, color={95,95,95}));
  connect(anvil.frame_a, contacts.frame[2]) annotation (Line(points={{30,-60},{30,-40},{60,-40}}, color={95,95,95}));
  annotation (
    experiment(StopTime=1, Tolerance=1e-8, Interval=0.001),
    Documentation(info="<html>
<p>
Arm and hammer are a double pendulum with its shoulder in the world. The hammer falls from 0.6 rad above the
horizontal, strikes the anvil at 0.2522 s with 2.47 m/s, rebounds, touches it once more and falls off. Plot <code>contacts.normalForce[1]</code> and
<code>contacts.impactSpeed[1]</code>. Until the first impact the motion is that of the free double pendulum.
</p>
</html>"));
end HammerOnAnvil;
