model Cart "A cart on two driven wheels pushes a load through a gate"
  import SI = Modelica.Units.SI;
  import Modelica.Mechanics.MultiBody;
  parameter SI.Radius wheelRadius=0.08 "Radius of the wheels";
  parameter SI.Length halfTrack=0.14 "Distance of a wheel from the middle";
  parameter Real gain(unit="N.m.s/rad")=0.3 "Torque of a motor for a deviation of its speed";
  parameter SI.Torque strongest=2 "Greatest torque of a motor";
  parameter SI.Time reaction=0.1 "Time constant with which wishes are followed";
  parameter SI.Acceleration steepest=1 "Greatest acceleration that is asked for";
  parameter SI.AngularAcceleration steepestTurn=4 "Greatest angular acceleration that is asked for";
  inner MultiBody.World world(
    enableAnimation=false,
    g=9.81,
    n={0,0,-1}) annotation (Placement(transformation(extent={{-160,80},{-140,100}})));
  Modelica.Blocks.Interfaces.RealInput speed(
    unit="m/s",
    min=-0.4,
    max=0.4,
    start=0) "Speed, negative backwards" annotation (Placement(transformation(extent={{-200,20},{-160,60}})));
  Modelica.Blocks.Interfaces.RealInput turning(
    unit="rad/s",
    min=-1.5,
    max=1.5,
    start=0) "Turning rate, positive to the left" annotation (Placement(transformation(extent={{-200,-60},{-160,-20}})));
  ContactMultiBody.Parts.Body chassis(
    m=3,
    r_CM={-0.02,0,0},
    I_11=0.011,
    I_22=0.024,
    I_33=0.033,
    geometry=ContactMultiBody.Shapes.box({0.3,0.2,0.06}, {0.01,0,0.02}),
    material=plastic,
    r_0(start={-0.8,-0.3,wheelRadius - 0.0001}, each fixed=true),
    v_0(start={0,0,0}, each fixed=true),
    angles_fixed=true,
    angles_start={0,0,0},
    w_0_fixed=true,
    w_0_start={0,0,0},
    enforceStates=true) "Chassis; its origin lies between the wheels"
    annotation (Placement(transformation(extent={{-100,0},{-80,20}})));
  MultiBody.Parts.FixedTranslation leftMount(r={0,halfTrack,0}) annotation (Placement(transformation(extent={{-60,40},{-40,60}})));
  MultiBody.Joints.Revolute leftAxle(
    n={0,1,0},
    useAxisFlange=true,
    phi(start=0, fixed=true),
    w(start=0, fixed=true),
    stateSelect=StateSelect.always) annotation (Placement(transformation(extent={{-30,40},{-10,60}})));
  ContactMultiBody.Parts.Body leftWheel(
    m=0.3,
    r_CM={0,0,0},
    I_11=0.0008,
    I_22=0.0008,
    I_33=0.0008,
    geometry=ContactMultiBody.Shapes.sphere(wheelRadius),
    material=rubber) annotation (Placement(transformation(extent={{0,40},{20,60}})));
  Modelica.Mechanics.Rotational.Sources.Torque leftMotor annotation (Placement(transformation(extent={{-60,70},{-40,90}})));
  Modelica.Mechanics.Rotational.Sources.Torque rightMotor annotation (Placement(transformation(extent={{-60,-90},{-40,-70}})));
  MultiBody.Parts.FixedTranslation rightMount(r={0,-halfTrack,0}) annotation (Placement(transformation(extent={{-60,-60},{-40,-40}})));
  MultiBody.Joints.Revolute rightAxle(
    n={0,1,0},
    useAxisFlange=true,
    phi(start=0, fixed=true),
    w(start=0, fixed=true),
    stateSelect=StateSelect.always) annotation (Placement(transformation(extent={{-30,-60},{-10,-40}})));
  ContactMultiBody.Parts.Body rightWheel(
    m=0.3,
    r_CM={0,0,0},
    I_11=0.0008,
    I_22=0.0008,
    I_33=0.0008,
    geometry=ContactMultiBody.Shapes.sphere(wheelRadius),
    material=rubber) annotation (Placement(transformation(extent={{0,-60},{20,-40}})));
  MultiBody.Parts.FixedTranslation casterMount(r={-0.12,0,-0.05}) annotation (Placement(transformation(extent={{-60,-10},{-40,10}})));
  ContactMultiBody.Parts.Body caster(
    m=0.1,
    r_CM={0,0,0},
    I_11=4e-5,
    I_22=4e-5,
    I_33=4e-5,
    geometry=ContactMultiBody.Shapes.sphere(0.03),
    material=slippery) "Ball that slides" annotation (Placement(transformation(extent={{-30,-10},{-10,10}})));
  ContactMultiBody.Parts.Body load(
    m=1,
    r_CM={0,0,0},
    I_11=0.00375,
    I_22=0.00375,
    I_33=0.00375,
    geometry=ContactMultiBody.Shapes.box({0.15,0.15,0.15}),
    material=plastic,
    r_0(start={0.4,0,0.075 - 0.00002}, each fixed=true),
    v_0(start={0,0,0}, each fixed=true),
    angles_fixed=true,
    angles_start={0,0,0},
    w_0_fixed=true,
    w_0_start={0,0,0},
    enforceStates=true) "What is pushed" annotation (Placement(transformation(extent={{60,40},{80,60}})));
  ContactMultiBody.Parts.Ground floor(material=rubber) annotation (Placement(transformation(extent={{60,0},{80,20}})));
  ContactMultiBody.Parts.Ground leftPost(
    r={1,0.31,0.15},
    geometry=ContactMultiBody.Shapes.box({0.06,0.06,0.3}),
    material=plastic) annotation (Placement(transformation(extent={{60,-40},{80,-20}})));
  ContactMultiBody.Parts.Ground rightPost(
    r={1,-0.31,0.15},
    geometry=ContactMultiBody.Shapes.box({0.06,0.06,0.3}),
    material=plastic) annotation (Placement(transformation(extent={{60,-80},{80,-60}})));
  ContactMultiBody.ContactManager contacts(
    n=8,
    collider={chassis.collider,leftWheel.collider,rightWheel.collider,caster.collider,load.collider,floor.collider,leftPost.collider,
        rightPost.collider},
    pairs={{2,6},{3,6},{4,6},{5,6},{1,5},{5,7},{5,8},{1,7},{1,8},{2,7},{3,8}},
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness=fill(1e5, 11),
    useRestitution=false,
    steadyRate=fill(20, 11),
    friction=ContactMultiBody.Types.Friction.Regularised) annotation (Placement(transformation(extent={{120,-20},{160,20}})));
  SI.Angle heading "Direction in which the cart looks, from the x axis";
protected
  parameter ContactMultiBody.Materials.Material rubber(
    restitution=0,
    muStatic=0.8,
    muDynamic=0.8) "Wheels and floor";
  parameter ContactMultiBody.Materials.Material plastic(
    restitution=0,
    muStatic=0.3,
    muDynamic=0.3) "Chassis, load and posts";
  parameter ContactMultiBody.Materials.Material slippery(
    restitution=0,
    muStatic=0.02,
    muDynamic=0.02) "Caster";
  SI.Velocity v(start=0, fixed=true, stateSelect=StateSelect.always) "Speed that is asked for at present";
  SI.AngularVelocity w(start=0, fixed=true, stateSelect=StateSelect.always) "Turning rate that is asked for at present";
equation
  der(v) = noEvent(max(-steepest, min(steepest, (speed - v)/reaction)));
  der(w) = noEvent(max(-steepestTurn, min(steepestTurn, (turning - w)/reaction)));
  leftMotor.tau = noEvent(max(-strongest, min(strongest, gain*((v - halfTrack*w)/wheelRadius - leftAxle.w))));
  rightMotor.tau = noEvent(max(-strongest, min(strongest, gain*((v + halfTrack*w)/wheelRadius - rightAxle.w))));
  heading = atan2(chassis.frame_a.R.T[1, 2], chassis.frame_a.R.T[1, 1]);
  connect(chassis.frame_a, leftMount.frame_a) annotation (Line(points={{-100,10},{-110,10},{-110,50},{-60,50}}, color={95,95,95}));
  connect(leftMount.frame_b, leftAxle.frame_a) annotation (Line(points={{-40,50},{-30,50}}, color={95,95,95}));
  connect(leftAxle.frame_b, leftWheel.frame_a) annotation (Line(points={{-10,50},{0,50}}, color={95,95,95}));
  connect(leftMotor.flange, leftAxle.axis) annotation (Line(points={{-40,80},{-20,80},{-20,60}}));
  connect(rightMotor.flange, rightAxle.axis) annotation (Line(points={{-40,-80},{-6,-80},{-6,-36},{-20,-36},{-20,-40}}));
  connect(chassis.frame_a, rightMount.frame_a) annotation (Line(points={{-100,10},{-110,10},{-110,-50},{-60,-50}}, color={95,95,95}));
  connect(rightMount.frame_b, rightAxle.frame_a) annotation (Line(points={{-40,-50},{-30,-50}}, color={95,95,95}));
  connect(rightAxle.frame_b, rightWheel.frame_a) annotation (Line(points={{-10,-50},{0,-50}}, color={95,95,95}));
  connect(chassis.frame_a, casterMount.frame_a) annotation (Line(points={{-100,10},{-110,10},{-110,0},{-60,0}}, color={95,95,95}));
  connect(casterMount.frame_b, caster.frame_a) annotation (Line(points={{-40,0},{-30,0}}, color={95,95,95}));
  connect(chassis.frame_a, contacts.frame[1]) annotation (Line(points={{-100,10},{-110,10},{-110,76},{110,76},{110,0},{120,0}}, color={95,95,95}));
  connect(leftWheel.frame_a, contacts.frame[2]) annotation (Line(points={{0,50},{-4,50},{-4,30},{110,30},{110,0},{120,0}}, color={95,95,95}));
  connect(rightWheel.frame_a, contacts.frame[3]) annotation (Line(points={{0,-50},{-4,-50},{-4,-90},{110,-90},{110,0},{120,0}}, color={95,95,95}));
  connect(caster.frame_a, contacts.frame[4]) annotation (Line(points={{-30,0},{-34,0},{-34,-16},{110,-16},{110,0},{120,0}}, color={95,95,95}));
  connect(load.frame_a, contacts.frame[5]) annotation (Line(points={{60,50},{50,50},{50,34},{110,34},{110,0},{120,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[6]) annotation (Line(points={{70,20},{70,26},{110,26},{110,0},{120,0}}, color={95,95,95}));
  connect(leftPost.frame_a, contacts.frame[7]) annotation (Line(points={{70,-20},{70,-14},{110,-14},{110,0},{120,0}}, color={95,95,95}));
  connect(rightPost.frame_a, contacts.frame[8]) annotation (Line(points={{70,-60},{70,-54},{110,-54},{110,0},{120,0}}, color={95,95,95}));
  annotation (
    uses(Modelica(version="4.1.0"), ContactMultiBody(version="0.1.0")),
    experiment(StopTime=10, Tolerance=1e-4, Interval=0.01),
    Diagram(coordinateSystem(preserveAspectRatio=false, extent={{-200,-100},{180,100}})),
    Documentation(info="<html>
<p>
Wheels and pushed load move by friction alone. The motors follow the speeds that the two inputs ask for, with limited accelerations and torques.
</p>
</html>"));
end Cart;
