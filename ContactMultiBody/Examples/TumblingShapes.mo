within ContactMultiBody.Examples;
model TumblingShapes "A ball, a box and a capsule tumble over each other, by the compiled response"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Mass m=1 "Mass of each body";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody ball(
    m=m,
    r_CM={0,0,0},
    I_11=0.004,
    I_22=0.004,
    I_33=0.004,
    geometry=Shapes.sphere(0.1),
    r_0(start={0,0,0.15}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,40},{-20,60}})));
  Parts.FreeBody box(
    m=m,
    r_CM={0,0,0},
    I_11=0.007,
    I_22=0.007,
    I_33=0.007,
    geometry=Shapes.box({0.2,0.2,0.2}),
    r_0(start={0.05,0.02,0.42}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,10},{-20,30}})));
  Parts.FreeBody capsule(
    m=m,
    r_CM={0,0,0},
    I_11=0.008,
    I_22=0.008,
    I_33=0.003,
    geometry=Shapes.capsule(0.07, 0.2),
    r_0(start={0.02,-0.05,0.75}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={1.2,0.3,0},
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,-20},{-20,0}})));
  Parts.Ground floor annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  CompiledContactManager contacts(
    n=4,
    geometry={ball.geometry,box.geometry,capsule.geometry,floor.geometry},
    material={ball.material,box.material,capsule.material,floor.material},
    inertia={ball.inertia,box.inertia,capsule.inertia,floor.inertia},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={1e5,1e5,1e5,Modelica.Constants.inf},
    regularisationSpeed=5e-3,
    spinRadius=0.01,
    rollingLever=0.005) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(ball.frame_a, contacts.frame[1]) annotation (Line(points={{-40,50},{-60,50},{-60,0},{20,0}}, color={95,95,95}));
  connect(box.frame_a, contacts.frame[2]) annotation (Line(points={{-40,20},{-60,20},{-60,0},{20,0}}, color={95,95,95}));
  connect(capsule.frame_a, contacts.frame[3]) annotation (Line(points={{-40,-10},{-60,-10},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[4]) annotation (Line(points={{-30,-40},{-30,-30},{0,-30},{0,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-6, Interval=0.005),
    Documentation(info="<html>
<p>
A box falls on a ball, and a capsule on both. The model has one wrench a body and no equations of pairs. In the end the floor carries the weight of all three:
<code>contacts.force[4,3]</code> = -29.43 N.
</p>
</html>"));
end TumblingShapes;
