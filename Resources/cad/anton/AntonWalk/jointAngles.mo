within AntonWalk;
pure function jointAngles "Inverse kinematics of a leg: angles of the joints for a place of the foot"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position foot[3] "Centre of the foot against the hip: outward, sideways (counterclockwise), up";
  input Modelica.Units.SI.Length coxa "Length from the hip's axis to the lift axis";
  input Modelica.Units.SI.Length femur "Length from the lift axis to the knee";
  input Modelica.Units.SI.Length tibia "Length from the knee to the foot's centre";
  output Modelica.Units.SI.Angle phi[3] "Angles of hip, lift and knee; the knee points up";
protected
  Modelica.Units.SI.Length reach "Distance of the foot from the lift axis, outward";
  Real cosKnee(unit="1") "Cosine of the knee's angle, by the law of cosines";
algorithm
  reach := sqrt(foot[1]^2 + foot[2]^2) - coxa;
  cosKnee := max(-1, min(1, (reach^2 + foot[3]^2 - femur^2 - tibia^2)/(2*femur*tibia)));
  phi := {atan2(foot[2], foot[1]),atan2(foot[3], reach) + atan2(tibia*sqrt(1 - cosKnee^2), femur + tibia*cosKnee),-acos(cosKnee)};
  annotation (Inline=false, Documentation(info="<html>
<p>
The hip turns the leg's plane towards the foot; in that plane femur and tibia form a triangle whose third side is known. A foot out of reach
is approached with the leg stretched.
</p>
</html>"));
end jointAngles;
