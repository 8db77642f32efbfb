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
  constant Real dNearby(unit="1")=8 "Damping factor up to which the root is known nearly";
  Real d(unit="1") "Damping factor, not zero";
  Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
algorithm
  d := max(damping, 1e-3);
  q := min(max(approachSpeed/sqrt(specificEnergy + Modelica.Constants.small), -qMax), qMax);
  ratio := (if d > dNearby then Internal.heavilyDamped(q, d) else Internal.moderatelyDamped(q, d, logarithmAtSeparation))/d;
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
solved by four Newton steps for the unknown sigma with t = (ln(1 + d) sigma<sup>2</sup> + ln(1 - d e))/(1 + sigma<sup>2</sup>),
in which the relation has no singularity, from a root that is known nearly; where d is above 8, for 1 + d r itself
(<a href=\"modelica://ContactMultiBody.NormalForce.Internal.heavilyDamped\">heavilyDamped</a>). The result is accurate to 1e-12 of the
force and as smooth as the relation.
</p>
</html>"));
end memorylessSpeedRatio;
