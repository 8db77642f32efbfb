within ContactMultiBody.Friction;
pure function spinTorque "Torque against turning about the normal"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce "Normal force";
  input Real normal[3](each unit="1") "Unit normal of the contact";
  input Modelica.Units.SI.AngularVelocity w[3] "Angular velocity of the first body against the second";
  input Real mu(min=0, unit="1") "Coefficient of friction";
  input Modelica.Units.SI.Radius radius "Radius of the area of contact";
  input Modelica.Units.SI.AngularVelocity regularisationSpeed "Angular speed over which the torque changes its direction";
  output Modelica.Units.SI.Torque torque[3] "Torque on the first body";
algorithm
  torque := -2/3*mu*radius*normalForce*(w*normal)/sqrt((w*normal)^2 + regularisationSpeed^2)*normal;
  annotation (Inline=false, Documentation(info="<html>
<p>
T = 2/3 &mu; F<sub>n</sub> a, the torque of a round area of contact of radius a under even pressure. It matters for single points of contact, as of a
sphere; where several points carry, their friction forces already make the torque.
</p>
</html>"));
end spinTorque;
