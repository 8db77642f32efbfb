within ContactMultiBodyTest.Rest;
model BoxOnCorner "A box is dropped on its corner and ends flat"
  extends Modelica.Icons.Example;
  extends BoxOnEdge(angles={0.4,0.5,0.2}, box(r_0(start={0,0,0.25}, each fixed=true)));
  annotation (experiment(StopTime=3, Tolerance=1e-6, Interval=0.002), Documentation(info="<html>
<p>It strikes with a corner first, then with others.</p>
</html>"));
end BoxOnCorner;
