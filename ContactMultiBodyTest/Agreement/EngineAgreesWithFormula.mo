within ContactMultiBodyTest.Agreement;
model EngineAgreesWithFormula "The contact engine and pure Modelica give the same motion"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Body ball[2](
    each m=1,
    each r_CM={0,0,0},
    each I_11=0.004,
    each I_22=0.004,
    each I_33=0.004,
    each geometry=ContactMultiBody.Shapes.sphere(0.1),
    r_0(start={{0,0,0.4},{0,0,0.4}}, each fixed=true),
    v_0(start={{1,0.5,0},{1,0.5,0}}, each fixed=true),
    each angles_fixed=true,
    each w_0_fixed=true);
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=2,
    geometry={ball[1].geometry,floor.geometry},
    material={ball[1].material,floor.material},
    pointCapacity=1);
  ContactMultiBody.PureModelica.SphereOnHalfSpace contact(radius=0.1, material={ball[2].material,floor.material});
  Modelica.Units.SI.Distance difference "Largest difference of the coordinates";
equation
  difference = max(abs(ball[1].r_0 - ball[2].r_0));
  connect(ball[1].frame_a, contacts.frame[1]);
  connect(floor.frame_a, contacts.frame[2]);
  connect(ball[2].frame_a, contact.frame[1]);
  connect(floor.frame_a, contact.frame[2]);
  annotation (experiment(StopTime=1, Tolerance=1e-9), Documentation(info="<html>
<p>Two spheres with the same start fall on the same floor, one by the engine, one by the formula; <code>difference</code> stays zero.</p>
</html>"));
end EngineAgreesWithFormula;
