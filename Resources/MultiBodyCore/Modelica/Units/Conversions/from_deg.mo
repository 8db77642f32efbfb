within Modelica.Units.Conversions;
function from_deg "Degree to radian"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.NonSI.Angle_deg degree "Angle in degree";
  output Modelica.Units.SI.Angle radian "Angle in radian";
algorithm
  radian := degree*(Modelica.Constants.pi/180);
  annotation (Inline=true, Documentation(info="<html><p>Converts degree to radian.</p></html>"));
end from_deg;
