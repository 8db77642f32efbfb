within ContactMultiBody.NormalForce.Internal;
pure function heavilyDamped "Root of the speed ratio's equation for damping factors above 8"
  extends Modelica.Icons.Function;
  input Real q(unit="1") "Scaled speed (dx/dt)/sqrt(s)";
  input Real damping(min=8, unit="1") "Damping factor d";
  output Real root(unit="1") "d r";
protected
  Real m(unit="1") "d - ln(1 + d)";
  Real between(unit="1") "1 + d r below which its logarithm is sought";
  Real qBetween(unit="1") "q there";
algorithm
  m := damping - log(1 + damping);
  between := 0.5/m;
  qBetween := -(1 - between)/sqrt(m + 1 + log(between) - between);
  root := if q > qBetween then heavilyDampedByPower(q, m, damping - m, between)
    else heavilyDampedByLogarithm(min(q, qBetween), m, between);
  annotation (Documentation(info="<html>
<p>
With m = d - ln(1 + d) the relation of <a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>
is y - 1 = q (sqrt(q<sup>2</sup>/4 + m + ln y) - q/2) for y = 1 + d r. Where damping is heavy, m is large and the logarithm changes the
square root little: Newton's method for y comes to the root from one side, in four steps to 1e-13. Where y is so small that its logarithm
decides, at the end of a contact, that is sought: (1 - e<sup>t</sup>)<sup>2</sup>/q<sup>2</sup> = t - e<sup>t</sup> + 1 + m for t = ln y.
</p>
</html>"));
end heavilyDamped;
