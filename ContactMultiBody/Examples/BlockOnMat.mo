within ContactMultiBody.Examples;
model BlockOnMat "A block whose centre of mass is not in its middle stands askew on a mat"
  extends Modelica.Icons.Example;
  parameter Real k(unit="N/m3")=2e5 "Modulus of the mat, pressure by depth";
  parameter Modelica.Units.SI.Position offset=0.02 "From the middle of the block to its centre of mass";
  final parameter Modelica.Units.SI.Length size[3]={0.3,0.2,0.1} "Size of the block";
  final parameter Modelica.Units.SI.Mass m=5 "Mass of the block";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}) annotation (Placement(transformation(extent={{-100,-100},{-80,-80}})));
  Parts.FreeBody body(
    m=m,
    r_CM={offset,0,0},
    I_11=m*(size[2]^2 + size[3]^2)/12,
    I_22=m*(size[1]^2 + size[3]^2)/12,
    I_33=m*(size[1]^2 + size[2]^2)/12,
    geometry=Shapes.box(size),
    material=Materials.Material(restitution=0.1, muStatic=0.8),
    r_0(start={0,0,size[3]/2 + 0.001}, each fixed=true),
    v_0(each fixed=true),
    angles_fixed=true,
    w_0_fixed=true) annotation (Placement(transformation(extent={{-40,20},{-20,40}})));
  Parts.Ground mat(material=Materials.Material(restitution=0.1, muStatic=0.8))
    annotation (Placement(transformation(extent={{-40,-60},{-20,-40}})));
  VolumeContactManager contacts(
    n=2,
    geometry={body.geometry,mat.geometry},
    material={body.material,mat.material},
    foundationModulus={k}) annotation (Placement(transformation(extent={{20,-20},{60,20}})));
  Real slope(unit="1") "Sine of the block's tilt";
equation
  slope = -body.frame_a.R.T[1, 3];
  connect(body.frame_a, contacts.frame[1]) annotation (Line(points={{-40,30},{-60,30},{-60,0},{20,0}}, color={95,95,95}));
  connect(mat.frame_a, contacts.frame[2]) annotation (Line(points={{-30,-40},{-30,0},{20,0}}, color={95,95,95}));
  annotation (
    experiment(StopTime=5, Tolerance=1e-6, Interval=0.005),
    Documentation(info="<html>
<p>
The pressure under the block is linear. It carries the weight at the mean depth m g/(k A), 4.0875 mm here, and its moment at the tilt m g offset/(k I), with the second
moment I = l<sup>3</sup> w/12 of the face: plot <code>slope</code>, which ends at 0.0109.
</p>
</html>"));
end BlockOnMat;
