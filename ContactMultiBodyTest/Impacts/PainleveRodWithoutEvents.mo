within ContactMultiBodyTest.Impacts;
model PainleveRodWithoutEvents "A rod that jams, with restitution without events"
  extends Modelica.Icons.Example;
  extends PainleveRod(contacts(restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless));
  annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>As <a href=\"modelica://ContactMultiBodyTest.Impacts.PainleveRod\">PainleveRod</a>, restitution by the present state alone.</p>
</html>"));
end PainleveRodWithoutEvents;
