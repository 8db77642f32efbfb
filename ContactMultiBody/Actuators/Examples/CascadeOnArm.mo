within ContactMultiBody.Actuators.Examples;
model CascadeOnArm "A cascade controller lifts an arm against gravity"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}) "World" annotation (Placement(transformation(extent={{-80,-60},{-60,-40}})));
  Modelica.Mechanics.MultiBody.Joints.Revolute shoulder(
    useAxisFlange=true,
    n={0,-1,0},
    phi(start=0, fixed=true),
    w(start=0, fixed=true)) "Joint" annotation (Placement(transformation(extent={{-20,-60},{0,-40}})));
  Modelica.Mechanics.MultiBody.Parts.Body arm(
    m=2,
    r_CM={0.3,0,0},
    I_11=1e-3,
    I_22=0.02,
    I_33=0.02) "Arm" annotation (Placement(transformation(extent={{40,-60},{60,-40}})));
  Rotational.CascadeServo drive(
    useSupport=true,
    ratio=50,
    J=5e-5,
    J_design=1.3e-4) "Motor and controller" annotation (Placement(transformation(extent={{-20,0},{0,20}})));
  Modelica.Blocks.Sources.Step step(height=0.6, startTime=0.5) "Wanted angle" annotation (Placement(transformation(extent={{-60,0},{-40,20}})));
equation
  connect(step.y, drive.phi_ref) annotation (Line(points={{-39,10},{-22,10}}, color={0,0,127}));
  connect(world.frame_b, shoulder.frame_a) annotation (Line(points={{-60,-50},{-20,-50}}, color={95,95,95}, thickness=0.5));
  connect(shoulder.frame_b, arm.frame_a) annotation (Line(points={{0,-50},{40,-50}}, color={95,95,95}, thickness=0.5));
  connect(drive.flange, shoulder.axis) annotation (Line(points={{0,10},{10,10},{10,-30},{-10,-30},{-10,-40}}));
  connect(drive.support, shoulder.support) annotation (Line(points={{-10,0},{-10,-20},{-16,-20},{-16,-40}}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
The integral part of the speed loop carries the arm's weight: <code>drive.phi</code> ends at 0.6 rad without a deviation, and the motor then has the
current m g r cos(0.6)/(50 k) = 1.943 A.
</p>
</html>"));
end CascadeOnArm;
