within ContactMultiBody.NormalForce.Internal;
pure function moderatelyDamped "Root of the speed ratio's equation for damping factors up to 8"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  input Real damping(min=1e-3, unit="1") "Damping factor d";
  input Real logarithmAtSeparation(max=0, unit="1") "ln(1 - d e)";
  output Real root(unit="1") "d r";
protected
  Real start(unit="1") "ln(1 + d), t at the start of the contact";
  Real c(unit="1") "Constant of the equation";
  Real span(unit="1") "Range of t";
  Real sigma(unit="1") "Unknown of Newton's method";
  Real p(unit="1") "sigma^2";
  Real t(unit="1") "ln(1 + d r)";
  Real E(unit="1") "d r";
  Real g(unit="1") "v0/(d sqrt(s))";
  Real part(unit="1") "1/(1 + sigma^2)";
algorithm
  start := log(1 + damping);
  c := 1 + damping - start;
  span := start - logarithmAtSeparation;
  sigma := sigmaNearby(q, damping, logarithmAtSeparation);
  for i in 1:4 loop
    p := sigma^2;
    part := 1/(1 + p);
    t := (start*p + logarithmAtSeparation)*part;
    E := exp(t) - 1;
    g := 1/sqrt(t - exp(t) + c);
    sigma := sigma - sigma*(E*g - q)/(E*g - q + 2*p*span*part^2*g*(E + 1 + 0.5*E^2*g^2));
  end for;
  p := sigma^2;
  root := exp((start*p + logarithmAtSeparation)/(1 + p)) - 1;
  annotation (Documentation(info="<html>
<p>Four Newton steps, from a root that is known nearly; see <a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>.</p>
</html>"));
end moderatelyDamped;
