within ContactMultiBody.NormalForce;
pure function exact "Damping factor that delivers exactly the restitution asked for"
  extends Internal.PartialDampingFactor;
protected
  constant Real eMin(unit="1")=5e-4 "Smaller coefficients would need unbounded damping";
  constant Real eSeries(unit="1")=0.98 "Above, logarithms cancel and the equation is solved by its series";
  Real e(unit="1") "Restitution within the range the law can deliver";
  Real q(unit="1") "Restitution within the range of Newton's method";
  Real u(unit="1") "-ln(1 - d e), the unknown of Newton's method";
  Real y(unit="1") "d e";
  Real series(unit="1") "Solution by series";
algorithm
  e := min(max(restitution, eMin), 1);
  series := 0;
  for i in 1:8 loop
    series := 3/(1 + e^3)*((1 - e^2)/2 + series^2*((1 - e^4)/4 - series*((1 + e^5)/5 - series*((1 - e^6)/6 - series*(1
       + e^7)/7))));
  end for;
  q := min(e, eSeries);
  u := (1 - q^2)/q;
  for i in 1:6 loop
    y := 1 - exp(-u);
    u := u - ((1 + q)*y/q - log(1 + y/q) - u)/((1 + q)*(1 - y)/q - (1 - y)/(q + y) - 1);
  end for;
  damping := if e > eSeries then series else (1 - exp(-u))/q;
  annotation (Documentation(info="<html>
<p>
Solves (1 + d)/(1 - d e) = exp(d (1 + e)) for d; for e towards 1, d tends to 3(1 - e)/2, for e towards 0 to 1/e. The
coefficient of restitution is limited to the range 0.0005 ... 1, which bounds d by 2000. The number of Newton steps is fixed, so that the function can be
translated to expressions; the relative error is below 1e-9.
</p>
</html>"));
end exact;
