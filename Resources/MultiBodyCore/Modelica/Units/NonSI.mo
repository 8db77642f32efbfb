within Modelica.Units;
package NonSI "Quantities in units outside the SI"
  extends Modelica.Icons.Package;
  type Angle_deg = Real(final quantity="Angle", final unit="deg") "Angle in degree";
  type AngularVelocity_rpm = Real(final quantity="AngularVelocity", final unit="rev/min") "Revolutions in a minute";
  type Velocity_kmh = Real(final quantity="Velocity", final unit="km/h") "Kilometres in an hour";
  annotation (Documentation(info="<html>
<p>Types for quantities in units that are in use beside the SI.
Convert with <a href=\"modelica://Modelica.Units.Conversions\">Conversions</a>.</p>
</html>"));
end NonSI;
