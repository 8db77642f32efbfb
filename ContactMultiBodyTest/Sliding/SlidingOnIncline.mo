within ContactMultiBodyTest.Sliding;
model SlidingOnIncline "A box on an incline of 17.4 degrees accelerates by 0.12526 m/s2, with coefficient 0.3"
  extends Modelica.Icons.Example;
  extends ContactMultiBody.Examples.BoxOnIncline(contacts(friction=ContactMultiBody.Types.Friction.Anchored));
  annotation (experiment(StopTime=2, Tolerance=1e-8), Documentation(info="<html>
<p>Constant acceleration g (sin(angle) - mu cos(angle)).</p>
</html>"));
end SlidingOnIncline;
