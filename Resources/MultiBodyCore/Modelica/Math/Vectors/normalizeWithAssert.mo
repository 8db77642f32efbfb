within Modelica.Math.Vectors;
function normalizeWithAssert "Vector divided by its length; the zero vector is an error"
  extends Modelica.Icons.Function;
  input Real v[:] "Vector, not zero";
  output Real result[size(v, 1)] "Vector of length 1";
algorithm
  assert(length(v) > 0, "The zero vector has no direction: give a vector that is not zero");
  result := v/length(v);
  annotation (Documentation(info="<html>
<p>Returns the unit vector in the direction of <code>v</code>; stops with an error if <code>v</code> is zero.</p></html>"));
end normalizeWithAssert;
