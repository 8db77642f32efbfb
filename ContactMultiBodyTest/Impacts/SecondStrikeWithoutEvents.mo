within ContactMultiBodyTest.Impacts;
model SecondStrikeWithoutEvents "The same without events"
  extends Modelica.Icons.Example;
  extends SecondStrike(restitutionMethod=ContactMultiBody.Types.RestitutionMethod.Memoryless);
  annotation (experiment(StopTime=0.02, Tolerance=1e-6), Documentation(info="<html>
<p>Each point recovers the speed at which it began to touch by itself.</p>
</html>"));
end SecondStrikeWithoutEvents;
