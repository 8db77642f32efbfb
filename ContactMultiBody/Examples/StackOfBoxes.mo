within ContactMultiBody.Examples;
model StackOfBoxes "Three boxes dropped onto each other settle and stand"
  extends Modelica.Icons.Example;
  final parameter Modelica.Units.SI.Length a=0.2 "Edge of the boxes";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of each box";
  final parameter Modelica.Units.SI.Inertia J=m*a^2/6 "Moment of inertia of each box";
  final parameter Modelica.Units.SI.Distance gap=1e-3 "Height from which each box falls";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody box[3](
    each m=m,
    each r_CM={0,0,0},
    each I_11=J,
    each I_22=J,
    each I_33=J,
    each geometry=Shapes.box({a,a,a}),
    each material=Materials.Material(restitution=0.2, muStatic=0.5),
    r_0(start={{0,0,a/2 + gap},{0.01,0,3*a/2 + 2*gap},{0,0.01,5*a/2 + 3*gap}}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground floor(material=Materials.Material(restitution=0.2, muStatic=0.5))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=4,
    geometry={box[1].geometry,box[2].geometry,box[3].geometry,floor.geometry},
    material={box[1].material,box[2].material,box[3].material,floor.material},
    pairs={{1,4},{2,1},{3,2}},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={1e6,1e6,1e6},
    friction=Types.Friction.Anchored) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
equation
  connect(box[1].frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(box[2].frame_a, contacts.frame[2]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(box[3].frame_a, contacts.frame[3]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(floor.frame_a, contacts.frame[4]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-7, Interval=0.005),
    Documentation(info="<html>
<p>
Three boxes, each shifted by 10 mm against the next, fall 1 mm each and come to rest as a stack. The floor then carries 3 m g = 29.43 N,
the first box 2 m g and the second m g: plot <code>contacts.normalForce</code>. The heights stay within the depths
m g/K = 0.01 mm of the sizes.
</p>
</html>"));
end StackOfBoxes;
