within ContactMultiBodyTest.Agreement;
model ShapesByBothWays "Forces between moved bodies of many shapes by the equations of the library and by the engine"
  extends Modelica.Icons.Example;
  BothWays restitution;
  BothWays springDamper(law=ContactMultiBody.Types.NormalLaw.SpringDamper, turning=true);
  BothWays constantDamping(useRestitution=false, friction=ContactMultiBody.Types.Friction.None);
  annotation (experiment(StopTime=50, Tolerance=1e-6, Interval=0.1), Documentation(info="<html>
<p>The differences of each <code>comparison</code> stay zero to rounding.</p>
</html>"));
end ShapesByBothWays;
