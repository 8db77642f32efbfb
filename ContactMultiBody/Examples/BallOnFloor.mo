within ContactMultiBody.Examples;
model BallOnFloor "A ball bounces, each time to the square of the restitution of its last height"
  extends Modelica.Icons.Example;
  parameter Real e(min=0, max=1, unit="1")=0.7 "Coefficient of restitution";
  parameter Modelica.Units.SI.Position height=1 "Height from which the ball is dropped";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody ball(
    m=1,
    r_CM={0,0,0},
    I_11=0.004,
    I_22=0.004,
    I_33=0.004,
    geometry=Shapes.sphere(0.1),
    material=Materials.Material(restitution=e),
    r_0(start={0,0,0.1 + height}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true,
    sphereDiameter=0.2) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=e))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={ball.geometry,floor.geometry},
    material={ball.material,floor.material},
    pointCapacity=1,
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={1e6}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(ball.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
A ball is dropped from 1 m. Plot <code>ball.r_0[3]</code>: after bounce i the ball rises to e<sup>2i</sup> of the height, and the
bounces end sqrt(2h/g) (1 + e)/(1 - e) = 2.5586 s after it was dropped. The compliant floor makes each contact last about
3 ms; slow bounces lose a little more than e says, as the weight acts while the ball touches.
</p>
</html>"));
end BallOnFloor;
