within ContactMultiBodyTest.Sliding;
model PlatePushedAtCorner "A plate that is pushed at its corner, along an edge"
  extends Modelica.Icons.Example;
  extends PushedBody(grip(r={a/2,a/2,-height/2}));
  parameter Real share(unit="1")=0.97 "Share of the least force that moves the plate";
  final parameter Modelica.Units.SI.Force least=0.7592316*mu*m*world.g "Least force that moves the plate";
equation
  push.force = {share*least*min(time/0.1, 1),0,0};
  annotation (experiment(StopTime=0.5, Tolerance=1e-6, Interval=0.001), Documentation(info="<html>
<p>
Pushed at its corner a plate turns. The least force that moves it is the least that any centre of rotation gives: the moment of the
friction at the four corners, &mu; m g/4 times their distances from the centre, by the distance of the force's line from it.
That is 0.7592316 &mu; m g, by a centre beyond the opposite edge, 0.858 a from the middle.
</p>
</html>"));
end PlatePushedAtCorner;
