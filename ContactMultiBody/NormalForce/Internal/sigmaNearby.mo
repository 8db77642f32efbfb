within ContactMultiBody.NormalForce.Internal;
pure function sigmaNearby "Unknown of the speed ratio's equation, to some percent"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  input Real damping(min=1e-3, unit="1") "Damping factor d";
  input Real logarithmAtSeparation(max=0, unit="1") "ln(1 - d e)";
  output Real sigma(unit="1") "Near the root";
protected
  Real start(unit="1") "ln(1 + d), t at the start of the contact";
  Real span(unit="1") "Range of t";
  Real middle(unit="1") "Root where q is 0";
  Real slope(unit="1") "d sigma/dq there";
  Real rate(unit="1") "By which |q| grows with sigma towards the start, or with 1/sigma towards the end";
  Real n(unit="1") "Value that the root has by that rate where q is 0";
  Real y(unit="1") "sigma, or 1/sigma where q is negative";
algorithm
  start := log(1 + damping);
  span := start - logarithmAtSeparation;
  middle := sqrt(-logarithmAtSeparation/start);
  slope := middle*sqrt(damping - start)*(1 + middle^2)^2/(2*middle^2*span);
  rate := sqrt((if q > 0 then damping else 1 - exp(logarithmAtSeparation))/span);
  n := if q > 0 then rate*middle else rate/middle;
  y := (abs(q)/2 + sqrt(q^2/4 + n*(2*rate*(if q > 0 then slope else slope/middle^2) - 1)*abs(q) + n^2))/rate;
  sigma := if q > 0 then y else 1/y;
  annotation (Documentation(info="<html>
<p>
With t = (ln(1 + d) sigma<sup>2</sup> + ln(1 - d e))/(1 + sigma<sup>2</sup>) the scaled speed q = (e<sup>t</sup> - 1)/sqrt(t - e<sup>t</sup> + 1 + d - ln(1 + d))
tends to sigma sqrt(d/span) towards the start of a contact and to -sqrt(d e/span)/sigma towards its end. Both branches here have these
asymptotes, and the root and its slope where q is 0. Four steps of Newton's method from there reach 1e-13 for damping factors up to 8,
which are those of coefficients of restitution from 0.12 on.
</p>
</html>"));
end sigmaNearby;
