within ContactMultiBodyTest.Agreement;
model OneListOfColliders "One list of colliders does what lists of geometries, materials and inertias do"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body ball[2](
    each m=1,
    each r_CM={0,0,0},
    each I_11=0.004,
    each I_22=0.004,
    each I_33=0.004,
    each geometry=ContactMultiBody.Shapes.sphere(0.1),
    each material=ContactMultiBody.Materials.Material(restitution=0.3, muStatic=0.2),
    r_0(start={{0,0,0.15},{0,0,0.15}}, each fixed=true),
    v_0(start={{0.5,0.2,0},{0.5,0.2,0}}, each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor(material=ContactMultiBody.Materials.Material(restitution=0.6, muStatic=0.8));
  ContactMultiBody.ContactManager together(
    n=2,
    collider={ball[1].collider,floor.collider},
    pointCapacity=1,
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  ContactMultiBody.ContactManager apart(
    n=2,
    geometry={ball[2].geometry,floor.geometry},
    material={ball[2].material,floor.material},
    inertia={ball[2].inertia,floor.inertia},
    pointCapacity=1,
    restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  Modelica.Units.SI.Distance difference "Largest difference of the coordinates";
equation
  difference = max(abs(ball[1].r_0 - ball[2].r_0));
  connect(ball[1].frame_a, together.frame[1]);
  connect(floor.frame_a, together.frame[2]);
  connect(ball[2].frame_a, apart.frame[1]);
  connect(floor.frame_a, apart.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-8, Interval=0.002), Documentation(info="<html>
<p>Two balls fall on a floor and are rubbed by it; <code>difference</code> stays zero.</p>
</html>"));
end OneListOfColliders;
