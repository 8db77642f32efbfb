within ContactMultiBody.Examples;
model BoxOnIncline "A box slides down an incline that is steeper than its friction holds"
  extends Modelica.Icons.Example;
  parameter Modelica.Units.SI.Angle angle=Modelica.Units.Conversions.from_deg(17.4) "Angle of the incline";
  parameter Real mu(min=0, unit="1")=0.3 "Coefficient of friction";
  final parameter Modelica.Units.SI.Length size[3]={0.2,0.2,0.1} "Size of the box";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the box";
  final parameter Real K(unit="N/m")=1e6 "Stiffness";
  final parameter Modelica.Units.SI.Length settled=m*world.g*cos(angle)/K "Depth at which the floor carries the box";
  final parameter Real normal[3](each unit="1")={sin(angle),0,cos(angle)} "Normal of the incline";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1})
    annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody box(
    m=m,
    r_CM={0,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=Shapes.box(size),
    material=Materials.Material(restitution=0.3, muStatic=mu),
    r_0(start=(size[3]/2 - settled)*normal, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    angles_start={0,angle,0},
    w_0_fixed=true,
    sphereDiameter=0.1) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground incline(normal=normal, material=Materials.Material(restitution=0.3, muStatic=mu))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  ContactManager contacts(
    n=2,
    geometry={box.geometry,incline.geometry},
    material={box.material,incline.material},
    stiffnessChoice=Types.StiffnessChoice.Given,
    stiffness={K}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
  Modelica.Units.SI.Position s "Way of the box down the incline";
  Modelica.Units.SI.Velocity v "Speed of the box down the incline";
equation
  s = box.r_0*{cos(angle),0,-sin(angle)};
  v = box.v_0*{cos(angle),0,-sin(angle)};
  connect(box.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(incline.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=2, Tolerance=1e-8, Interval=0.005),
    Documentation(info="<html>
<p>
A box rests on an incline. It stays if tan(angle) is less than the coefficient of friction, else it slides with the
acceleration g (sin(angle) - mu cos(angle)): 0.12526 m/s<sup>2</sup> at 17.4 degrees with mu = 0.3. Plot <code>v</code>.
</p>
</html>"));
end BoxOnIncline;
