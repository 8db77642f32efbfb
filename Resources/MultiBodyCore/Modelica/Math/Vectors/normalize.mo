within Modelica.Math.Vectors;
function normalize "Vector divided by its length; short vectors are left finite"
  extends Modelica.Icons.Function;
  input Real v[:] "Vector";
  input Real eps(min=0) = 100*Modelica.Constants.eps "A length below eps counts as eps";
  output Real result[size(v, 1)] "Vector of length 1, or v/eps where v is shorter than eps";
algorithm
  result := v/max(length(v), eps);
  annotation (Documentation(info="<html>
<p>Returns the unit vector in the direction of <code>v</code>. A vector shorter than <code>eps</code> is divided by
<code>eps</code> instead: the result then is shorter than 1, continuous in <code>v</code>, and zero for the zero vector.</p></html>"));
end normalize;
