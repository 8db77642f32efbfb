within ContactMultiBodyTest.Scenes;
model ShapesFromFiles "A mesh and a hull from a file are as far from a floor as the file says"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world(g=9.81, n={0,0,-1});
  ContactMultiBody.Parts.Ground mesh(r={0,0,0.5}, geometry=ContactMultiBody.Shapes.meshFile(
        Modelica.Utilities.Files.loadResource("modelica://ContactMultiBodyTest/Resources/tetrahedron.obj"), 1e-3));
  ContactMultiBody.Parts.Ground hull(r={1,0,0.25}, geometry=ContactMultiBody.Shapes.hullFile(
        Modelica.Utilities.Files.loadResource("modelica://ContactMultiBodyTest/Resources/tetrahedron.obj"), 1e-3));
  ContactMultiBody.Parts.Ground floor;
  ContactMultiBody.ContactManager contacts(
    n=3,
    geometry={mesh.geometry,hull.geometry,floor.geometry},
    material={mesh.material,hull.material,floor.material},
    pairs={{1,3},{2,3}},
    friction=ContactMultiBody.Types.Friction.None);
equation
  connect(mesh.frame_a, contacts.frame[1]);
  connect(hull.frame_a, contacts.frame[2]);
  connect(floor.frame_a, contacts.frame[3]);
  annotation (experiment(StopTime=0.01, Tolerance=1e-6), Documentation(info="<html>
<p>The distances are 0.5 m and 0.25 m.</p>
</html>"));
end ShapesFromFiles;
