within AntonWalk;
pure function jointSpeeds "Inverse kinematics of a leg: speeds of the joints for a motion of the foot"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position foot[3] "Centre of the foot against the hip: outward, sideways (counterclockwise), up";
  input Modelica.Units.SI.Velocity velocity[3] "Its derivative";
  input Modelica.Units.SI.Angle phi[3] "Angles of hip, lift and knee there";
  input Modelica.Units.SI.Length femur "Length from the lift axis to the knee";
  input Modelica.Units.SI.Length tibia "Length from the knee to the foot's centre";
  output Modelica.Units.SI.AngularVelocity w[3] "Speeds of hip, lift and knee";
protected
  Modelica.Units.SI.Length radius "Distance of the foot from the hip's axis";
  Modelica.Units.SI.Velocity reachSpeed "Derivative of the radius";
  Modelica.Units.SI.AngularVelocity lift "Speed of the lift";
algorithm
  radius := sqrt(foot[1]^2 + foot[2]^2);
  reachSpeed := (foot[1]*velocity[1] + foot[2]*velocity[2])/radius;
  lift := (reachSpeed*cos(phi[2] + phi[3]) + velocity[3]*sin(phi[2] + phi[3]))/(femur*sin(phi[3]));
  w := {(foot[1]*velocity[2] - foot[2]*velocity[1])/radius^2,lift,-lift - (reachSpeed*cos(phi[2]) + velocity[3]*sin(phi[2]))/(tibia*sin(
    phi[3]))};
  annotation (Inline=false, Documentation(info="<html>
<p>The inverse of the leg's Jacobian, which is regular unless the leg is stretched or folded.</p>
</html>"));
end jointSpeeds;
