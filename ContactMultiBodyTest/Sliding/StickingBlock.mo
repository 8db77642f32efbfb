within ContactMultiBodyTest.Sliding;
model StickingBlock "A block on an incline that friction just holds"
  extends Modelica.Icons.Example;
  extends BlockOnIncline(angle=Modelica.Units.Conversions.from_deg(16));
  annotation (experiment(StopTime=20, Tolerance=1e-8, Interval=0.02), Documentation(info="<html>
<p>tan(16 deg) = 0.287 is less than 0.3: after the static spring has given way a little, nothing moves.</p>
</html>"));
end StickingBlock;
