within Modelica.Units.Conversions;
function to_rpm "Radian per second to revolutions per minute"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.SI.AngularVelocity rs "Angular velocity in rad/s";
  output Modelica.Units.NonSI.AngularVelocity_rpm rpm "Revolutions in a minute";
algorithm
  rpm := rs*(30/Modelica.Constants.pi);
  annotation (Inline=true, Documentation(info="<html><p>Converts rad/s to revolutions per minute.</p></html>"));
end to_rpm;
