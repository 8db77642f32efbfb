within ContactMultiBody.NormalForce;
pure function deliveredRestitution "Restitution a damping factor delivers"
  extends Modelica.Icons.Function;
  input Real damping(min=0, unit="1") "Damping factor d";
  output Real restitution(unit="1") "Coefficient of restitution of the free impact";
algorithm
  restitution := (1 - exp(Internal.logarithmAtSeparation(damping)))/max(damping, 1e-3);
  annotation (Documentation(info="<html>
<p>
Inverse of <a href=\"modelica://ContactMultiBody.NormalForce.exact\">exact</a>: solves (1 + d)/(1 - d e) = exp(d (1 + e)) for e. It tells what
any law of the form F = K x<sup>n</sup> (1 + d (dx/dt)/v<sub>0</sub>) delivers, whatever it was asked for.
</p>
</html>"));
end deliveredRestitution;
