within ContactMultiBodyTest.Scenes;
model BodyWithoutGeometry "A body without geometry has the equations of its counterpart in the Modelica Standard Library"
  extends Modelica.Icons.Example;
  inner Modelica.Mechanics.MultiBody.World world;
  ContactMultiBody.Parts.Body mine(m=1, r_CM={0,0,0});
  Modelica.Mechanics.MultiBody.Parts.Body standard(m=1, r_CM={0,0,0});
  annotation (experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p><code>mine</code> and <code>standard</code> differ by the parameters geometry, material and inertia alone.</p>
</html>"));
end BodyWithoutGeometry;
