within Modelica.Units.Conversions;
function to_deg "Radian to degree"
  extends Modelica.Units.Icons.Conversion;
  input Modelica.Units.SI.Angle radian "Angle in radian";
  output Modelica.Units.NonSI.Angle_deg degree "Angle in degree";
algorithm
  degree := radian*(180/Modelica.Constants.pi);
  annotation (Inline=true, Documentation(info="<html><p>Converts radian to degree.</p></html>"));
end to_deg;
