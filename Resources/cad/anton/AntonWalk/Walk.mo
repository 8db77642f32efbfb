within AntonWalk;
model Walk "Anton walks straight ahead"
  import SI = Modelica.Units.SI;
  import Modelica.Constants.pi;
  extends Anton.Mechanics(
    contacts(pointCapacity=1, useRestitution=false, steadyRate=fill(20, 6)),
    frontLeftHip(useAxisFlange=true, phi(start=frontLeft.start[1], fixed=true)),
    frontLeftLift(useAxisFlange=true, phi(start=frontLeft.start[2], fixed=true)),
    frontLeftKnee(useAxisFlange=true, phi(start=frontLeft.start[3], fixed=true)),
    middleLeftHip(useAxisFlange=true, phi(start=middleLeft.start[1], fixed=true)),
    middleLeftLift(useAxisFlange=true, phi(start=middleLeft.start[2], fixed=true)),
    middleLeftKnee(useAxisFlange=true, phi(start=middleLeft.start[3], fixed=true)),
    rearLeftHip(useAxisFlange=true, phi(start=rearLeft.start[1], fixed=true)),
    rearLeftLift(useAxisFlange=true, phi(start=rearLeft.start[2], fixed=true)),
    rearLeftKnee(useAxisFlange=true, phi(start=rearLeft.start[3], fixed=true)),
    frontRightHip(useAxisFlange=true, phi(start=frontRight.start[1], fixed=true)),
    frontRightLift(useAxisFlange=true, phi(start=frontRight.start[2], fixed=true)),
    frontRightKnee(useAxisFlange=true, phi(start=frontRight.start[3], fixed=true)),
    middleRightHip(useAxisFlange=true, phi(start=middleRight.start[1], fixed=true)),
    middleRightLift(useAxisFlange=true, phi(start=middleRight.start[2], fixed=true)),
    middleRightKnee(useAxisFlange=true, phi(start=middleRight.start[3], fixed=true)),
    rearRightHip(useAxisFlange=true, phi(start=rearRight.start[1], fixed=true)),
    rearRightLift(useAxisFlange=true, phi(start=rearRight.start[2], fixed=true)),
    rearRightKnee(useAxisFlange=true, phi(start=rearRight.start[3], fixed=true)));
  parameter Gait gait "Gait";
  final parameter Real first(unit="1")=(gait.dutyFactor - 0.5)/2 "Place in the cycle of the group that has just been set down";
  final parameter Real second(unit="1")=first + 0.5 "Place in the cycle of the group that is lifted first";
  LegDrive frontLeft(gait=gait, offset=first, direction=pi/3) "Front left leg";
  LegDrive middleLeft(gait=gait, offset=second, direction=pi/2) "Middle left leg";
  LegDrive rearLeft(gait=gait, offset=first, direction=2*pi/3) "Rear left leg";
  LegDrive frontRight(gait=gait, offset=second, direction=-pi/3) "Front right leg";
  LegDrive middleRight(gait=gait, offset=first, direction=-pi/2) "Middle right leg";
  LegDrive rearRight(gait=gait, offset=second, direction=-2*pi/3) "Rear right leg";
  Real cycle(unit="1") "Cycles since the start";
  Real rate(unit="1/s") "Derivative of cycle";
  SI.Position commandedTravel "Way that the gait asks for";
  SI.Position travel "Way of the torso";
  SI.Height bodyHeight "Height of the hips above the floor";
  SI.Force footForce[6]=contacts.normalForce "Normal forces of front, middle, rear left, front, middle, rear right foot";
  SI.Force totalFootForce=sum(footForce) "Sum of the normal forces";
protected
  Real ramp(unit="1") "Share of the ramp that is over";
equation
  ramp = noEvent(max(0, min(1, (time - gait.startTime)/gait.rampTime)));
  rate = ramp^2*(3 - 2*ramp)/gait.period;
  cycle = (gait.rampTime*ramp^3*(1 - ramp/2) + noEvent(max(0, time - gait.startTime - gait.rampTime)))/gait.period;
  commandedTravel = gait.way*cycle;
  travel = torso.frame_a.r_0[1];
  bodyHeight = torso.frame_a.r_0[3];
  frontLeft.cycle = cycle;
  frontLeft.rate = rate;
  connect(frontLeft.hip, frontLeftHip.axis);
  connect(frontLeft.lift, frontLeftLift.axis);
  connect(frontLeft.knee, frontLeftKnee.axis);
  middleLeft.cycle = cycle;
  middleLeft.rate = rate;
  connect(middleLeft.hip, middleLeftHip.axis);
  connect(middleLeft.lift, middleLeftLift.axis);
  connect(middleLeft.knee, middleLeftKnee.axis);
  rearLeft.cycle = cycle;
  rearLeft.rate = rate;
  connect(rearLeft.hip, rearLeftHip.axis);
  connect(rearLeft.lift, rearLeftLift.axis);
  connect(rearLeft.knee, rearLeftKnee.axis);
  frontRight.cycle = cycle;
  frontRight.rate = rate;
  connect(frontRight.hip, frontRightHip.axis);
  connect(frontRight.lift, frontRightLift.axis);
  connect(frontRight.knee, frontRightKnee.axis);
  middleRight.cycle = cycle;
  middleRight.rate = rate;
  connect(middleRight.hip, middleRightHip.axis);
  connect(middleRight.lift, middleRightLift.axis);
  connect(middleRight.knee, middleRightKnee.axis);
  rearRight.cycle = cycle;
  rearRight.rate = rate;
  connect(rearRight.hip, rearRightHip.axis);
  connect(rearRight.lift, rearRightLift.axis);
  connect(rearRight.knee, rearRightKnee.axis);
  annotation (
    experiment(StopTime=25, Tolerance=1e-4, Interval=0.007),
    Documentation(info="<html>
<p>
Anton stands with all feet on the floor, three of them in front and three behind their middle positions. With the start command the six
<a href=\"modelica://AntonWalk.LegDrive\">drives</a> begin their cycles, slowly at first.
</p>
</html>"));
end Walk;
