within ContactMultiBodyTest.Impacts;
model FreeImpactWithoutEvents "The same without events"
  extends Modelica.Icons.Example;
  extends FreeImpact(restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  annotation (experiment(StopTime=0.1, Tolerance=1e-6), Documentation(info="<html>
<p>The speed at the start of the contact is recovered from depth and speed.</p>
</html>"));
end FreeImpactWithoutEvents;
