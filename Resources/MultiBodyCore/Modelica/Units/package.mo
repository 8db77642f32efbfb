within Modelica;
package Units "Types with physical units and conversions between units"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Types for physical quantities after ISO 80000, types in other units that are in use, and functions that convert.</p>
</html>"));
end Units;
