within ContactMultiBody.NormalForce.Internal;
pure function logarithmAtSeparation "ln(1 + d r) where the contact ends"
  extends Modelica.Icons.Function;
  input Real damping(min=0, unit="1") "Damping factor d";
  output Real t(max=0, unit="1") "Negative root of t - exp(t) + 1 + d - ln(1 + d)";
protected
  Real c(unit="1") "Constant of the equation";
algorithm
  c := 1 + max(damping, 1e-3) - log(1 + max(damping, 1e-3));
  t := 1 - c - sqrt(2*(c - 1));
  for i in 1:6 loop
    t := t - (t - exp(t) + c)/(1 - exp(t));
  end for;
  annotation (Documentation(info="<html>
<p>
The equation of restitution (1+d)/(1-d e) = exp(d(1+e)) with t = ln(1 - d e). The function is concave and the start lies left of the root,
so that Newton's method converges from any d. Damping factors below 0.001 count as 0.001.
</p>
</html>"));
end logarithmAtSeparation;
