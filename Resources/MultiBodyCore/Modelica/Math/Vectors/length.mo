within Modelica.Math.Vectors;
function length "Euclidean length of a vector"
  extends Modelica.Icons.Function;
  input Real v[:] "Vector";
  output Real result "Its length";
algorithm
  result := sqrt(v*v);
  annotation (Inline=true, Documentation(info="<html><p>Returns <code>sqrt(v*v)</code>.</p></html>"));
end length;
