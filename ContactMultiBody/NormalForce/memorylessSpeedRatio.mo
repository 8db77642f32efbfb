within ContactMultiBody.NormalForce;
pure function memorylessSpeedRatio "Present speed by impact speed, from depth and speed alone"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Velocity approachSpeed "Approach speed dx/dt";
  input Real specificEnergy(min=0, unit="m2/s2") "Elastic energy by effective mass, K x^(n+1)/(m (n+1))";
  input Real damping(min=0, unit="1") "Damping factor d";
  input Real logarithmAtSeparation(max=0, unit="1") "ln(1 - d e)";
  output Real ratio(unit="1") "(dx/dt)/v0, between -e and 1";
protected
  constant Real qMax(unit="1")=1e4 "Limit of the scaled speed; beyond, the ratio is that at start or end of the contact";
  Real d(unit="1") "Damping factor, not zero";
  Real c(unit="1") "Constant of the equation";
  Real start(unit="1") "ln(1 + d), t at the start of the contact";
  Real span(unit="1") "Range of t";
  Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  Real low(unit="1") "Lower bound of l";
  Real high(unit="1") "Upper bound of l";
  Real l(unit="1") "Logarithm of sigma";
  Real sigma(unit="1") "Unknown of Newton's method";
  Real p(unit="1") "sigma^2";
  Real t(unit="1") "ln(1 + d r)";
  Real E(unit="1") "d r";
  Real h(unit="1") "d^2 s/v0^2";
algorithm
  d := max(damping, 1e-3);
  c := 1 + d - log(1 + d);
  start := log(1 + d);
  span := start - logarithmAtSeparation;
  q := min(max(approachSpeed/sqrt(specificEnergy + Modelica.Constants.small), -qMax), qMax);
  low := -10;
  high := 10;
  for i in 1:10 loop
    l := (low + high)/2;
    p := exp(2*l);
    t := (start*p + logarithmAtSeparation)/(1 + p);
    E := exp(t) - 1;
    h := t - exp(t) + c;
    low := if E*abs(E) < q*abs(q)*h then l else low;
    high := if E*abs(E) < q*abs(q)*h then high else l;
  end for;
  sigma := exp((low + high)/2);
  for i in 1:3 loop
    p := sigma^2;
    t := (start*p + logarithmAtSeparation)/(1 + p);
    E := exp(t) - 1;
    h := t - exp(t) + c;
    sigma := sigma - sigma*(E/sqrt(h) - q)/(E/sqrt(h) - q + 2*sigma^2*span/(1 + p)^2*((E + 1)/sqrt(h) + E^2/(2*h*sqrt(h))));
  end for;
  p := sigma^2;
  ratio := (exp((start*p + logarithmAtSeparation)/(1 + p)) - 1)/d;
  annotation (Documentation(info="<html>
<p>
During a free impact of the effective mass m under F = K x<sup>n</sup> (1 + d r), r = (dx/dt)/v<sub>0</sub>, the relation
</p>
<blockquote><pre>
s/v0^2 = (1 - r)/d - ln((1 + d)/(1 + d r))/d^2   with   s = K x^(n+1)/(m (n+1))
</pre></blockquote>
<p>
holds. So q = (dx/dt)/sqrt(s) determines r, and with it the force, from the present state alone: no event, no memory, finite at
rest. With t = ln(1 + d r) the relation becomes (e<sup>t</sup> - 1) = q sqrt(t - e<sup>t</sup> + 1 + d - ln(1 + d)). It is
solved by ten bisections and three Newton steps for the unknown sigma with t = (ln(1 + d) sigma<sup>2</sup> + ln(1 - d e))/(1 + sigma<sup>2</sup>),
in which the relation has no singularity; the result is accurate to 1e-10 of the force and as smooth as the relation.
</p>
</html>"));
end memorylessSpeedRatio;
