within ContactMultiBodyTest.Rest;
model StackOfBoxes "Five boxes stand on each other"
  extends Modelica.Icons.Example;
  final parameter Integer count=5 "Number of boxes";
  final parameter Modelica.Units.SI.Length side=0.2 "Edges of the boxes";
  final parameter Modelica.Units.SI.Mass m=1 "Mass of each";
  final parameter Modelica.Units.SI.TranslationalSpringConstant K=1e6 "Stiffness of the contacts";
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1}, enableAnimation=false);
  ContactMultiBody.Parts.Body box[count](
    each m=m,
    each r_CM={0,0,0},
    each I_11=m*side^2/6,
    each I_22=m*side^2/6,
    each I_33=m*side^2/6,
    each geometry=ContactMultiBody.Shapes.box({side,side,side}),
    each material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.5),
    r_0(start={{0,0,side/2},{0.01,0,3*side/2},{-0.01,0,5*side/2},{0.01,0.01,7*side/2},{0,-0.01,9*side/2}}, each fixed=true),
    v_0(each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true,
    each animation=false);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.5));
  ContactMultiBody.ContactManager contacts(
    n=6,
    geometry={box[1].geometry,box[2].geometry,box[3].geometry,box[4].geometry,box[5].geometry,floor.geometry},
    material={box[1].material,box[2].material,box[3].material,box[4].material,box[5].material,floor.material},
    pairs={{1,6},{2,1},{3,2},{4,3},{5,4}},
    friction=ContactMultiBody.Types.Friction.Anchored,
    stiffnessChoice=ContactMultiBody.Types.StiffnessChoice.Given,
    stiffness=fill(K, 5));
equation
  connect(box[1].frame_a, contacts.frame[1]);
  connect(box[2].frame_a, contacts.frame[2]);
  connect(box[3].frame_a, contacts.frame[3]);
  connect(box[4].frame_a, contacts.frame[4]);
  connect(box[5].frame_a, contacts.frame[5]);
  connect(floor.frame_a, contacts.frame[6]);
  annotation (experiment(StopTime=60, Tolerance=1e-6, Interval=0.05), Documentation(info="<html>
<p>The boxes stand a little askew, but each within the base of the one below, so that the stack stands.</p>
</html>"));
end StackOfBoxes;
