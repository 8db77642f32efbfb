within ContactMultiBody.Friction;
pure function rollingTorque "Torque against rolling"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce "Normal force";
  input Real normal[3](each unit="1") "Unit normal of the contact";
  input Modelica.Units.SI.AngularVelocity w[3] "Angular velocity of the first body against the second";
  input Modelica.Units.SI.Length lever "Coefficient of rolling friction, a length";
  input Modelica.Units.SI.AngularVelocity regularisationSpeed "Angular speed over which the torque changes its direction";
  output Modelica.Units.SI.Torque torque[3] "Torque on the first body";
protected
  Modelica.Units.SI.AngularVelocity rolling[3] "Part of the angular velocity in the plane of contact";
algorithm
  rolling := w - (w*normal)*normal;
  torque := -lever*normalForce/sqrt(rolling*rolling + regularisationSpeed^2)*rolling;
  annotation (Inline=false, Documentation(info="<html>
<p>
T = f F<sub>n</sub> against the rolling: the pressure in front of a rolling body is higher than behind it, which moves the normal force forward by the length f.
</p>
</html>"));
end rollingTorque;
