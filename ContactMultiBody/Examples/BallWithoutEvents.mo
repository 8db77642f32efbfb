within ContactMultiBody.Examples;
model BallWithoutEvents "A ball bounces and comes to rest without a single event"
  extends BallOnFloor(contacts(restitutionMethod=Types.RestitutionMethod.Memoryless, inertia={ball.inertia,floor.inertia}));
  annotation (
    experiment(StopTime=3, Tolerance=1e-8, Interval=0.002),
    Documentation(info="<html>
<p>
As <a href=\"modelica://ContactMultiBody.Examples.BallOnFloor\">BallOnFloor</a>, but the speed of impact is recovered from depth and speed
(<a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>), so that the model has neither events nor
discrete variables. The heights are those of BallOnFloor, and at rest the depth is exactly m g/K.
</p>
</html>"));
end BallWithoutEvents;
