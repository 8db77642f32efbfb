within ContactMultiBody.NormalForce.Internal;
pure function heavilyDampedByPower "Root of the speed ratio's equation for large damping factors, but for the end of a contact"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  input Real m(unit="1") "d - ln(1 + d)";
  input Real start(unit="1") "ln(1 + d), t at the start of the contact";
  input Real between(unit="1") "Smallest 1 + d r";
  output Real root(unit="1") "d r";
protected
  Real g(unit="1") "sqrt(q^2/4 + m + t)";
  Real t(unit="1") "ln(1 + d r)";
  Real y(unit="1") "1 + d r";
algorithm
  g := sqrt(q^2/4 + m + (if q > 0 then start else 0));
  y := max(between, 1 + q*(g - q/2));
  for i in 1:4 loop
    t := log(y);
    g := sqrt(q^2/4 + m + t);
    y := y - (y - 1 - q*(m + t)/(g + q/2))/(1 - q/(2*g*y));
  end for;
  t := log(y);
  root := q*(m + t)/(sqrt(q^2/4 + m + t) + q/2);
  annotation (Documentation(info="<html>
<p>See <a href=\"modelica://ContactMultiBody.NormalForce.Internal.heavilyDamped\">heavilyDamped</a>.</p>
</html>"));
end heavilyDampedByPower;
