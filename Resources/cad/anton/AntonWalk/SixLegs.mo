within AntonWalk;
partial model SixLegs "Anton with drives in its legs, without what moves them"
  import SI = Modelica.Units.SI;
  import Modelica.Constants.pi;
  extends Anton.Mechanics(
    contacts(pointCapacity=points, useRestitution=false, steadyRate=fill(20, pairs)),
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
  parameter Integer pairs=6 "Pairs of bodies that may touch; the first six are those of feet and floor";
  parameter Integer points=1 "Contact points of a pair at most";
  parameter Real startAdvance(unit="1")=1 "Share of the stride at the start";
  parameter Gait gait "Gait";
  final parameter Real first(unit="1")=(gait.dutyFactor - 0.5)/2 "Place in the cycle of the group that has just been set down";
  final parameter Real second(unit="1")=first + 0.5 "Place in the cycle of the group that is lifted first";
  LegDrive frontLeft(
    gait=gait,
    offset=first,
    direction=pi/3,
    hipPlace={0.17,0.075},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Front left leg"
    annotation (Placement(transformation(extent={{-140,-110},{-120,-90}})));
  LegDrive middleLeft(
    gait=gait,
    offset=second,
    direction=pi/2,
    hipPlace={0,0.095},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Middle left leg"
    annotation (Placement(transformation(extent={{-140,-350},{-120,-330}})));
  LegDrive rearLeft(
    gait=gait,
    offset=first,
    direction=2*pi/3,
    hipPlace={-0.17,0.075},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Rear left leg"
    annotation (Placement(transformation(extent={{-140,-590},{-120,-570}})));
  LegDrive frontRight(
    gait=gait,
    offset=second,
    direction=-pi/3,
    hipPlace={0.17,-0.075},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Front right leg"
    annotation (Placement(transformation(extent={{-140,-830},{-120,-810}})));
  LegDrive middleRight(
    gait=gait,
    offset=first,
    direction=-pi/2,
    hipPlace={0,-0.095},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Middle right leg"
    annotation (Placement(transformation(extent={{-140,-1070},{-120,-1050}})));
  LegDrive rearRight(
    gait=gait,
    offset=second,
    direction=-2*pi/3,
    hipPlace={-0.17,-0.075},
    startAdvance=startAdvance,
    cycle=cycle,
    rate=rate,
    advance=advance,
    advanceRate=advanceRate,
    turn=turn,
    turnRate=turnRate,
    raise=raise,
    raiseSpeed=raiseSpeed) "Rear right leg"
    annotation (Placement(transformation(extent={{-140,-1310},{-120,-1290}})));
  Real cycle(unit="1") "Cycles since the start";
  Real rate(unit="1/s") "Derivative of cycle";
  Real advance(unit="1") "Share of the stride, negative backwards";
  Real advanceRate(unit="1/s") "Its derivative";
  Real turn(unit="1") "Share of the turn in a stride, positive to the left";
  Real turnRate(unit="1/s") "Its derivative";
  SI.Height raise "Height of the torso above its usual one";
  SI.Velocity raiseSpeed "Its derivative";
  SI.Height bodyHeight "Height of the hips above the floor";
  SI.Force footForce[6]=contacts.normalForce[1:6] "Normal forces of front, middle, rear left, front, middle, rear right foot";
  SI.Force totalFootForce=sum(footForce) "Sum of the normal forces";
equation
  bodyHeight = torso.frame_a.r_0[3];
  connect(frontLeft.hip, frontLeftHip.axis)
    annotation (Line(points={{-120,-94},{-106,-94},{-106,-24},{0,-24},{0,-30}}));
  connect(frontLeft.lift, frontLeftLift.axis)
    annotation (Line(points={{-120,-100},{-110,-100},{-110,-84},{160,-84},{160,-90}}));
  connect(frontLeft.knee, frontLeftKnee.axis)
    annotation (Line(points={{-120,-106},{-114,-106},{-114,-144},{280,-144},{280,-150}}));
  connect(middleLeft.hip, middleLeftHip.axis)
    annotation (Line(points={{-120,-334},{-106,-334},{-106,-264},{0,-264},{0,-270}}));
  connect(middleLeft.lift, middleLeftLift.axis)
    annotation (Line(points={{-120,-340},{-110,-340},{-110,-324},{160,-324},{160,-330}}));
  connect(middleLeft.knee, middleLeftKnee.axis)
    annotation (Line(points={{-120,-346},{-114,-346},{-114,-384},{280,-384},{280,-390}}));
  connect(rearLeft.hip, rearLeftHip.axis)
    annotation (Line(points={{-120,-574},{-106,-574},{-106,-504},{0,-504},{0,-510}}));
  connect(rearLeft.lift, rearLeftLift.axis)
    annotation (Line(points={{-120,-580},{-110,-580},{-110,-564},{160,-564},{160,-570}}));
  connect(rearLeft.knee, rearLeftKnee.axis)
    annotation (Line(points={{-120,-586},{-114,-586},{-114,-624},{280,-624},{280,-630}}));
  connect(frontRight.hip, frontRightHip.axis)
    annotation (Line(points={{-120,-814},{-106,-814},{-106,-744},{0,-744},{0,-750}}));
  connect(frontRight.lift, frontRightLift.axis)
    annotation (Line(points={{-120,-820},{-110,-820},{-110,-804},{160,-804},{160,-810}}));
  connect(frontRight.knee, frontRightKnee.axis)
    annotation (Line(points={{-120,-826},{-114,-826},{-114,-864},{280,-864},{280,-870}}));
  connect(middleRight.hip, middleRightHip.axis)
    annotation (Line(points={{-120,-1054},{-106,-1054},{-106,-984},{0,-984},{0,-990}}));
  connect(middleRight.lift, middleRightLift.axis)
    annotation (Line(points={{-120,-1060},{-110,-1060},{-110,-1044},{160,-1044},{160,-1050}}));
  connect(middleRight.knee, middleRightKnee.axis)
    annotation (Line(points={{-120,-1066},{-114,-1066},{-114,-1104},{280,-1104},{280,-1110}}));
  connect(rearRight.hip, rearRightHip.axis)
    annotation (Line(points={{-120,-1294},{-106,-1294},{-106,-1224},{0,-1224},{0,-1230}}));
  connect(rearRight.lift, rearRightLift.axis)
    annotation (Line(points={{-120,-1300},{-110,-1300},{-110,-1284},{160,-1284},{160,-1290}}));
  connect(rearRight.knee, rearRightKnee.axis)
    annotation (Line(points={{-120,-1306},{-114,-1306},{-114,-1344},{280,-1344},{280,-1350}}));
  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=false, extent={{-180,-1520},{520,120}})),
    Documentation(info="<html>
<p>
Six <a href=\"modelica://AntonWalk.LegDrive\">drives</a> on the mechanics that were generated from the CAD export.
</p>
</html>"));
end SixLegs;
