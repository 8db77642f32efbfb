within ContactMultiBody.NormalForce;
pure function springDamper "Normal force of a spring and a damper in parallel"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth "Penetration depth";
  input Modelica.Units.SI.Velocity approachSpeed "Approach speed, positive while the depth grows";
  input Real stiffness(min=0) "Stiffness K in N/m^exponent";
  input Real exponent(min=1, unit="1") "Exponent n of the depth";
  input Modelica.Units.SI.TranslationalDampingConstant damping(min=0) "Damping constant at full depth";
  input Modelica.Units.SI.Length dampingDepth(min=Modelica.Constants.small) "Depth from which the damper acts fully";
  output Modelica.Units.SI.Force force "Normal force, never negative";
protected
  Real s(unit="1") "Share of the damper that acts";
algorithm
  s := min(max(depth/dampingDepth, 0), 1);
  force := if depth > 0 then max(0, stiffness*depth^exponent + s^2*(3 - 2*s)*damping*approachSpeed) else 0;
  annotation (Documentation(info="<html>
<p>
F = K x<sup>n</sup> + c s(x) dx/dt, never negative. The cubic step s(x) fades the damper in over the damping depth, so that
the force is zero at x = 0 and does not jump at impact. The restitution follows from mass, stiffness and speed; it is not asked for.
</p>
</html>"));
end springDamper;
