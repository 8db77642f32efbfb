within ContactMultiBodyTest.Impacts;
model PainleveRodAnchored "A rod that jams, with anchored friction"
  extends Modelica.Icons.Example;
  extends PainleveRod(contacts(friction=ContactMultiBody.Types.Friction.Anchored));
  annotation (experiment(StopTime=1, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>As <a href=\"modelica://ContactMultiBodyTest.Impacts.PainleveRod\">PainleveRod</a>, with static springs.</p>
</html>"));
end PainleveRodAnchored;
