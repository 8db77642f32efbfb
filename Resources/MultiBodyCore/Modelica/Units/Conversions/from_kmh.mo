within Modelica.Units.Conversions;
function from_kmh "Kilometre per hour to metre per second"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.NonSI.Velocity_kmh kmh "Speed in km/h";
  output Modelica.Units.SI.Velocity ms "Speed in m/s";
algorithm
  ms := kmh/3.6;
  annotation (Inline=true, Documentation(info="<html><p>Converts km/h to m/s.</p></html>"));
end from_kmh;
