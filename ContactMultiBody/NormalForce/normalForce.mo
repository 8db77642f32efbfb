within ContactMultiBody.NormalForce;
pure function normalForce "Normal force of one contact point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth "Penetration depth";
  input Modelica.Units.SI.Velocity approachSpeed "Approach speed, positive while the depth grows";
  input Real stiffness(min=0) "Stiffness K in N/m^exponent";
  input Real exponent(min=1, unit="1") "Exponent n of the depth";
  input Real rate(unit="s/m") "Damping factor by impact speed, d/v0";
  output Modelica.Units.SI.Force force "Normal force, never negative";
algorithm
  force := if depth > 0 then stiffness*depth^exponent*max(0, 1 + rate*approachSpeed) else 0;
  annotation (Documentation(info="<html>
<p>F = K x<sup>n</sup> (1 + (d/v<sub>0</sub>) dx/dt), never negative: contacts push, they do not pull.</p>
</html>"));
end normalForce;
