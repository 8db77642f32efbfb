within Modelica.Units.Conversions;
function to_unit1 "Give a number the unit 1"
  extends Modelica.Units.Icons.Conversion;
  input Real r "Number of any unit";
  output Real result(unit="1") "The same number";
algorithm
  result := r;
  annotation (Inline=true, Documentation(info="<html>
<p>Returns its argument. Used where a vector with a unit serves as a direction. Works on arrays element by element.</p></html>"));
end to_unit1;
