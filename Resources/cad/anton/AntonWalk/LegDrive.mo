within AntonWalk;
model LegDrive "Three servos that move a leg as the gait wants"
  import SI = Modelica.Units.SI;
  parameter Gait gait "Gait";
  parameter Real offset(unit="1") "Where the leg is in its cycle at the start";
  parameter SI.Angle direction "Direction in which the leg stands off, from the torso's x axis";
  parameter SI.Position hipPlace[2]={0,0} "Hip's axis against the point about which the torso turns, forward and to the left";
  parameter Real startAdvance(unit="1")=1 "Share of the stride at the start";
  parameter SI.Length coxa=0.05 "Length from the hip's axis to the lift axis" annotation (Dialog(group="Geometry"));
  parameter SI.Length femur=0.09 "Length from the lift axis to the knee" annotation (Dialog(group="Geometry"));
  parameter SI.Length tibia=0.135 "Length from the knee to the foot's centre" annotation (Dialog(group="Geometry"));
  parameter SI.Length reach=0.155 "Distance of the foot's middle position from the hip's axis" annotation (Dialog(group="Geometry"));
  parameter SI.Height height=0.09812 "Height of the hip above the centre of a standing foot" annotation (Dialog(group="Geometry"));
  parameter SI.Radius footRadius=0.012 "Radius of the foot's ball, which rolls as the shank tilts" annotation (Dialog(group="Geometry"));
  parameter SI.RotationalSpringConstant c[3]={600,900,300} "Gains of the angles of hip, lift and knee" annotation (Dialog(group="Servos"));
  parameter SI.RotationalDampingConstant d[3]={8,10,5} "Gains of the speeds" annotation (Dialog(group="Servos"));
  final parameter SI.Angle middle[3]=jointAngles({reach,0,-height}, coxa, femur, tibia) "Angles of the joints in the middle position";
  final parameter SI.Position startPath[2]=footPosition(offset, gait.dutyFactor, gait.stride, gait.lift) "Path at the start";
  final parameter SI.Position startFoot[3]={reach + startAdvance*startPath[1]*cos(direction),-startAdvance*startPath[1]*sin(direction),startPath[
      2] - height} "Foot at the start";
  final parameter SI.Position middlePlace[2]=hipPlace + reach*{cos(direction),sin(direction)}
    "Foot's middle position against the point about which the torso turns";
  final parameter SI.Angle start[3]=jointAngles(
      rolledFoot(startFoot, jointAngles(startFoot, coxa, femur, tibia), middle, footRadius), coxa, femur, tibia)
    "Angles of the joints at the start";
  Modelica.Blocks.Interfaces.RealInput cycle "Cycles since the start" annotation (Placement(transformation(extent={{-140,20},{-100,60}})));
  Modelica.Blocks.Interfaces.RealInput rate(unit="1/s") "Derivative of cycle" annotation (Placement(transformation(extent={{-140,-60},{-100,-20}})));
  input Real advance(unit="1")=1 "Share of the stride, negative backwards" annotation (Dialog(group="Motion of the torso"));
  input Real advanceRate(unit="1/s")=0 "Its derivative" annotation (Dialog(group="Motion of the torso"));
  input Real turn(unit="1")=0 "Share of the turn in a stride, positive to the left" annotation (Dialog(group="Motion of the torso"));
  input Real turnRate(unit="1/s")=0 "Its derivative" annotation (Dialog(group="Motion of the torso"));
  input SI.Height raise=0 "Height of the torso above its usual one" annotation (Dialog(group="Motion of the torso"));
  input SI.Velocity raiseSpeed=0 "Its derivative" annotation (Dialog(group="Motion of the torso"));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b hip "To the hip's axis" annotation (Placement(transformation(extent={{90,50},{110,70}})));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b lift "To the lift axis" annotation (Placement(transformation(extent={{90,-10},{110,10}})));
  Modelica.Mechanics.Rotational.Interfaces.Flange_b knee "To the knee's axis" annotation (Placement(transformation(extent={{90,-70},{110,-50}})));
  ContactMultiBody.Actuators.Rotational.Servo servo[3](c=c, d=d, each useSpeedReference=true) "Servos of hip, lift and knee"
    annotation (Placement(transformation(extent={{20,-10},{40,10}})));
protected
  SI.Position path[2] "Foot against its middle position, forward and up";
  SI.Length slope[2] "Derivative of the path by the cycle";
  SI.Position along "Foot against its middle position as the torso advances";
  SI.Velocity alongSpeed "Derivative of along";
  SI.Angle around "Angle by which the foot is turned about the torso";
  SI.AngularVelocity aroundSpeed "Derivative of around";
  SI.Position place[2] "Foot against its middle position, in the torso's axes";
  SI.Velocity placeSpeed[2] "Derivative of place";
  SI.Position foot[3] "Foot against the hip, outward, sideways, up";
  SI.Velocity velocity[3] "Derivative of foot";
  SI.Angle straight[3] "Angles for a foot that does not roll";
  SI.AngularVelocity straightSpeed[3] "Derivatives of straight";
  SI.Position rolled[3] "Foot with the distance it rolled";
  SI.Velocity rolledVelocity[3] "Derivative of rolled";
  SI.Angle phi[3] "Wanted angles";
equation
  path = footPosition(cycle + offset, gait.dutyFactor, gait.stride, gait.lift);
  slope = footSlope(cycle + offset, gait.dutyFactor, gait.stride, gait.lift);
  along = advance*path[1];
  alongSpeed = advance*rate*slope[1] + advanceRate*path[1];
  around = turn*gait.turn/gait.stride*path[1];
  aroundSpeed = gait.turn/gait.stride*(turn*rate*slope[1] + turnRate*path[1]);
  place = {along + (cos(around) - 1)*middlePlace[1] - sin(around)*middlePlace[2],sin(around)*middlePlace[1] + (cos(around) - 1)*middlePlace[2]};
  placeSpeed = {alongSpeed - aroundSpeed*(sin(around)*middlePlace[1] + cos(around)*middlePlace[2]),aroundSpeed*(cos(around)*middlePlace[1] -
    sin(around)*middlePlace[2])};
  foot = {reach + place[1]*cos(direction) + place[2]*sin(direction),place[2]*cos(direction) - place[1]*sin(direction),path[2] - height - raise};
  velocity = {placeSpeed[1]*cos(direction) + placeSpeed[2]*sin(direction),placeSpeed[2]*cos(direction) - placeSpeed[1]*sin(direction),rate*
    slope[2] - raiseSpeed};
  straight = jointAngles(foot, coxa, femur, tibia);
  straightSpeed = jointSpeeds(foot, velocity, straight, femur, tibia);
  rolled = rolledFoot(foot, straight, middle, footRadius);
  rolledVelocity = velocity + rollingVelocity(straight, straightSpeed, middle, footRadius);
  phi = jointAngles(rolled, coxa, femur, tibia);
  servo.phi_ref = jointAngles(rolled, coxa, femur, tibia);
  servo.w_ref = jointSpeeds(rolled, rolledVelocity, phi, femur, tibia);
  connect(servo[1].flange, hip) annotation (Line(points={{40,0},{70,0},{70,60},{100,60}}));
  connect(servo[2].flange, lift) annotation (Line(points={{40,0},{100,0}}));
  connect(servo[3].flange, knee) annotation (Line(points={{40,0},{70,0},{70,-60},{100,-60}}));
  annotation (
    Icon(graphics={
        Rectangle(extent={{-100,100},{100,-100}}, lineColor={0,0,0}, fillColor={255,255,255}, fillPattern=FillPattern.Solid),
        Line(points={{-60,20},{-20,20},{30,60},{60,-70}}, thickness=1),
        Ellipse(extent={{50,-60},{70,-80}}, fillColor={0,0,0}, fillPattern=FillPattern.Solid),
        Text(extent={{-150,150},{150,110}}, textColor={0,0,255}, textString="%name")}),
    Documentation(info="<html>
<p>
Feet that stand at the same time move against the torso as one rigid body, by translation (<code>advance</code>), rotation about the torso
(<code>turn</code>) and height (<code>raise</code>), so that none of them has to slip.
</p>
<p>
The path of the foot by <a href=\"modelica://AntonWalk.footPosition\">footPosition</a>, corrected by
<a href=\"modelica://AntonWalk.rolledFoot\">rolledFoot</a> for the ball that rolls under the shank; the joints' angles for it by
<a href=\"modelica://AntonWalk.jointAngles\">jointAngles</a>; the derivatives of all these; and a servo for each joint that follows angle
and speed. The lift carries the weight, so its servo is the stiffest; a softer knee lets the loaded leg give way sideways instead of
pushing against the friction of the foot.
</p>
</html>"));
end LegDrive;
