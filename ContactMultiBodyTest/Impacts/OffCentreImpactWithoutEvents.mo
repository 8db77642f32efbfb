within ContactMultiBodyTest.Impacts;
model OffCentreImpactWithoutEvents "The same without events"
  extends Modelica.Icons.Example;
  extends OffCentreImpact(restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  annotation (experiment(StopTime=0.0015, Tolerance=1e-6), Documentation(info="<html>
<p>The manager computes the effective mass from the inertia of both bodies, the arm of the contact and its normal.</p>
</html>"));
end OffCentreImpactWithoutEvents;
