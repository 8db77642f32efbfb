within ContactMultiBodyTest.Sliding;
model RegularisedStickingBlock "The same with regularised friction"
  extends Modelica.Icons.Example;
  extends StickingBlock(contacts(friction=ContactMultiBody.Types.Friction.Regularised, regularisationSpeed=1e-6));
  annotation (experiment(StopTime=20, Tolerance=1e-6, Interval=0.02), Documentation(info="<html>
<p>Regularised friction creeps with q/sqrt(1 - q^2) of its speed, q = tan(16 deg)/0.3 = 0.956 being the share of the friction that is used: 3.26e-6 m/s.</p>
</html>"));
end RegularisedStickingBlock;
