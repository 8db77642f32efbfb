within ContactMultiBodyTest.Impacts;
model ConeOnItsTip "A cone meets a floor with its apex, without gravity"
  extends Modelica.Icons.Example;
  extends FreeImpact(ball(geometry=ContactMultiBody.Shapes.cone(0.05, 0.2, {0,0,0}, {{1,0,0},{0,-1,0},{0,0,-1}})));
  annotation (experiment(StopTime=0.1, Tolerance=1e-6), Documentation(info="<html>
<p>The apex is where the ball's lowest point was.</p>
</html>"));
end ConeOnItsTip;
