within AntonWalk;
pure function rollingVelocity "Derivative of the distance rolled in rolledFoot"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Angle phi[3] "Angles of the joints";
  input Modelica.Units.SI.AngularVelocity w[3] "Their derivatives";
  input Modelica.Units.SI.Angle middle[3] "Angles of the joints where the rolled distance counts from";
  input Modelica.Units.SI.Radius radius "Radius of the foot";
  output Modelica.Units.SI.Velocity velocity[3] "Outward, sideways, up, against the hip";
algorithm
  velocity := -radius*((w[2] + w[3])*{cos(phi[1]),sin(phi[1]),0} + (phi[2] + phi[3] - middle[2] - middle[3])*w[1]*{-sin(phi[1]),cos(phi[1]),0});
  annotation (Inline=false, Documentation(info="<html>
<p>See <a href=\"modelica://AntonWalk.rolledFoot\">rolledFoot</a>.</p>
</html>"));
end rollingVelocity;
