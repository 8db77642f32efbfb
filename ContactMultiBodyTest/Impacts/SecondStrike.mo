within ContactMultiBodyTest.Impacts;
model SecondStrike "One end of a body strikes while the other still touches"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Types.RestitutionMethod;
  parameter Real e(min=0, max=1, unit="1")=0.5 "Coefficient of restitution asked for";
  parameter RestitutionMethod restitutionMethod=RestitutionMethod.ImpactSpeed "How the speed at the start of a contact is known"
    annotation (Evaluate=true);
  final parameter Modelica.Units.SI.Length l=0.3 "From the middle of the body to its ends";
  final parameter Modelica.Units.SI.Radius radius=0.02 "Radius of the ends";
  final parameter Modelica.Units.SI.Mass m=2 "Mass of the body";
  parameter Modelica.Units.SI.Velocity slow=0.02 "Speed of the end that touches first";
  parameter Modelica.Units.SI.Velocity fast=1 "Speed of the end that strikes then";
  inner Modelica.Mechanics.MultiBody.World world(gravityType=Modelica.Mechanics.MultiBody.Types.GravityTypes.NoGravity,
    enableAnimation=false);
  ContactMultiBody.Parts.Body body(
    m=m,
    r_CM={0,0,0},
    I_11=m*l^2,
    I_22=m*l^2,
    I_33=m*l^2,
    geometry=ContactMultiBody.Shapes.compound({ContactMultiBody.Shapes.sphere(radius, {-l,0,0}),ContactMultiBody.Shapes.sphere(radius,
        {l,0,0})}),
    material=ContactMultiBody.Materials.Material(restitution=e),
    r_0(start={0,0,radius + 2.5e-4}, each fixed=true),
    v_0(start={0,0,-(slow + fast)/2}, each fixed=true),
    angles_fixed=true,
    angles_start={0,-2.5e-4/l,0},
    w_0_fixed=true,
    w_0_start={0,(fast - slow)/(2*l),0},
    animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=e));
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={body.geometry,floor.geometry},
    material={body.material,floor.material},
    inertia={body.inertia,floor.inertia},
    friction=ContactMultiBody.Types.Friction.None,
    restitutionMethod=restitutionMethod,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness={1e6});
  Real delivered(unit="1") "Speed of the fast end by its speed before it struck";
equation
  delivered = (body.v_0[3] - l*body.w_a[2])/fast;
  connect(body.frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  annotation (experiment(StopTime=0.02, Tolerance=1e-6), Documentation(info="<html>
<p>
The inertia is that of two masses at the ends: neither end feels the other. The slow end touches from the start on, the fast one strikes after half a millisecond, while the slow contact still lasts; it must come
back with e of its own speed.
</p>
</html>"));
end SecondStrike;
