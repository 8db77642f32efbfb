within Modelica.Units.Conversions;
function from_rpm "Revolutions per minute to radian per second"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.NonSI.AngularVelocity_rpm rpm "Revolutions in a minute";
  output Modelica.Units.SI.AngularVelocity rs "Angular velocity in rad/s";
algorithm
  rs := rpm*(Modelica.Constants.pi/30);
  annotation (Inline=true, Documentation(info="<html><p>Converts revolutions per minute to rad/s.</p></html>"));
end from_rpm;
