within ContactMultiBody.NormalForce.Internal;
pure function heavilyDampedByLogarithm "Root of the speed ratio's equation for large damping factors at the end of a contact"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s), negative";
  input Real m(unit="1") "d - ln(1 + d)";
  input Real between(unit="1") "Largest 1 + d r";
  output Real root(unit="1") "d r";
protected
  Real t(unit="1") "ln(1 + d r)";
  Real y(unit="1") "1 + d r";
algorithm
  t := min(log(between), 1/q^2 - m - 1);
  for i in 1:4 loop
    y := exp(t);
    t := t + ((1 - y)^2/q^2 + y - m - 1 - t)/((1 - y)*(2*y/q^2 + 1));
  end for;
  root := exp(t) - 1;
  annotation (Documentation(info="<html>
<p>See <a href=\"modelica://ContactMultiBody.NormalForce.Internal.heavilyDamped\">heavilyDamped</a>.</p>
</html>"));
end heavilyDampedByLogarithm;
