within ContactMultiBodyTest.Sliding;
model AnchoredSlidingBlock "The same with friction that holds without creeping"
  extends Modelica.Icons.Example;
  extends SlidingBlock(friction=ContactMultiBody.Types.Friction.Anchored);
  annotation (experiment(StopTime=2, Tolerance=1e-8, Interval=0.002), Documentation(info="<html>
<p>It comes to rest after v0^2/(2 mu g) and then stays where it is.</p>
</html>"));
end AnchoredSlidingBlock;
