within ContactMultiBody.NormalForce.Internal;
pure function sigmaByBisection "Unknown of the speed ratio's equation, to 2 percent for any damping"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  input Real damping(min=1e-3, unit="1") "Damping factor d";
  input Real logarithmAtSeparation(max=0, unit="1") "ln(1 - d e)";
  output Real sigma(unit="1") "Near the root";
protected
  Real c(unit="1") "Constant of the equation";
  Real start(unit="1") "ln(1 + d), t at the start of the contact";
  Real low(unit="1") "Lower bound of l";
  Real high(unit="1") "Upper bound of l";
  Real l(unit="1") "Logarithm of sigma";
  Real p(unit="1") "sigma^2";
  Real t(unit="1") "ln(1 + d r)";
  Real E(unit="1") "d r";
  Real h(unit="1") "d^2 s/v0^2";
algorithm
  start := log(1 + damping);
  c := 1 + damping - start;
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
  annotation (Documentation(info="<html>
<p>Ten bisections for the logarithm, which is sought between -10 and 10. See <a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>.</p>
</html>"));
end sigmaByBisection;
