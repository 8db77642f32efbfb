within Modelica.Units.Conversions;
function to_kmh "Metre per second to kilometre per hour"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.SI.Velocity ms "Speed in m/s";
  output Modelica.Units.NonSI.Velocity_kmh kmh "Speed in km/h";
algorithm
  kmh := 3.6*ms;
  annotation (Inline=true, Documentation(info="<html><p>Converts m/s to km/h.</p></html>"));
end to_kmh;
