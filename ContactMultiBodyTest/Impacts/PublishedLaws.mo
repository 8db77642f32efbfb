within ContactMultiBodyTest.Impacts;
model PublishedLaws "Balls meet a floor without gravity, each under a published law"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Types.NormalLaw;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  final parameter Modelica.Units.SI.Velocity speed=1 "Speed of the balls";
  final parameter Modelica.Units.SI.Radius radius=0.1 "Radius of the balls";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body ball[8](
    each m=0.5,
    each r_CM={0,0,0},
    each I_11=0.002,
    each I_22=0.002,
    each I_33=0.002,
    each material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={{i,0,radius + 1e-3} for i in 1:8}, each fixed=true),
    v_0(start={{0,0,-speed} for i in 1:8}, each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.PureModelica.SphereOnHalfSpace juhasz(
    radius=radius,
    material={ball[1].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.Juhasz);
  ContactMultiBody.PureModelica.SphereOnHalfSpace huntCrossley(
    radius=radius,
    material={ball[2].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.HuntCrossley);
  ContactMultiBody.PureModelica.SphereOnHalfSpace herbertMcWhannell(
    radius=radius,
    material={ball[3].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.HerbertMcWhannell);
  ContactMultiBody.PureModelica.SphereOnHalfSpace leeWang(
    radius=radius,
    material={ball[4].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.LeeWang);
  ContactMultiBody.PureModelica.SphereOnHalfSpace lankaraniNikravesh(
    radius=radius,
    material={ball[5].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.LankaraniNikravesh);
  ContactMultiBody.PureModelica.SphereOnHalfSpace gonthier(
    radius=radius,
    material={ball[6].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.Gonthier);
  ContactMultiBody.PureModelica.SphereOnHalfSpace flores(
    radius=radius,
    material={ball[7].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.Flores);
  ContactMultiBody.PureModelica.SphereOnHalfSpace huGuo(
    radius=radius,
    material={ball[8].material,floor.material},
    friction=ContactMultiBody.Types.Friction.None,
    normalLaw=NormalLaw.HuGuo);
  Real delivered[8](each unit="1") "Speed after the impact by the speed before it, in the order of the components";
equation
  for i in 1:8 loop
    delivered[i] = ball[i].v_0[3]/speed;
  end for;
  connect(ball[1].frame_a, juhasz.frame[1]);
  connect(floor.frame_a, juhasz.frame[2]);
  connect(ball[2].frame_a, huntCrossley.frame[1]);
  connect(floor.frame_a, huntCrossley.frame[2]);
  connect(ball[3].frame_a, herbertMcWhannell.frame[1]);
  connect(floor.frame_a, herbertMcWhannell.frame[2]);
  connect(ball[4].frame_a, leeWang.frame[1]);
  connect(floor.frame_a, leeWang.frame[2]);
  connect(ball[5].frame_a, lankaraniNikravesh.frame[1]);
  connect(floor.frame_a, lankaraniNikravesh.frame[2]);
  connect(ball[6].frame_a, gonthier.frame[1]);
  connect(floor.frame_a, gonthier.frame[2]);
  connect(ball[7].frame_a, flores.frame[1]);
  connect(floor.frame_a, flores.frame[2]);
  connect(ball[8].frame_a, huGuo.frame[1]);
  connect(floor.frame_a, huGuo.frame[2]);
  annotation (experiment(StopTime=0.1, Tolerance=1e-6), Documentation(info="<html>
<p>What each law delivers where e is asked for; the table of <a href=\"modelica://ContactMultiBody.NormalForce\">NormalForce</a> says what that should be.</p>
</html>"));
end PublishedLaws;
