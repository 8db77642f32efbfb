within ContactMultiBody.NormalForce;
pure function memorylessForce "Normal force that delivers a restitution without events"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth "Penetration depth";
  input Modelica.Units.SI.Velocity approachSpeed "Approach speed, positive while the depth grows";
  input Real stiffness(min=0) "Stiffness K in N/m^exponent";
  input Real exponent(min=1, unit="1") "Exponent n of the depth";
  input Modelica.Units.SI.Acceleration springDeceleration "Deceleration by the spring alone, K x^n/m";
  input Real damping(min=0, unit="1") "Damping factor d";
  input Real logarithmAtSeparation(max=0, unit="1") "ln(1 - d e)";
  output Modelica.Units.SI.Force force "Normal force, never negative";
algorithm
  force := if depth > 0 then stiffness*depth^exponent*max(0, 1 + damping*memorylessSpeedRatio(
    approachSpeed, depth*springDeceleration/(exponent + 1), damping, logarithmAtSeparation)) else 0;
  annotation (Documentation(info="<html>
<p>
F = K x<sup>n</sup> (1 + d r) with r from
<a href=\"modelica://ContactMultiBody.NormalForce.memorylessSpeedRatio\">memorylessSpeedRatio</a>.
</p>
</html>"));
end memorylessForce;
