within ContactMultiBody.Friction;
pure function anchoredForce "Friction force of a spring between anchor and contact point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce "Normal force";
  input Modelica.Units.SI.Position stretch[3] "Tangential way of the first body since the anchor was set";
  input Modelica.Units.SI.Velocity slidingVelocity[3] "Velocity of the first body against the second, tangential";
  input Modelica.Units.SI.TranslationalSpringConstant stiffness "Stiffness of the static spring";
  input Modelica.Units.SI.TranslationalDampingConstant damping "Damping of the static spring";
  input Real mu(min=0, unit="1") "Coefficient of friction at the present speed";
  output Modelica.Units.SI.Force force[3] "Force on the first body";
protected
  Modelica.Units.SI.Force trial[3] "Force of spring and damper";
  Modelica.Units.SI.Force size2 "Magnitude of the trial force";
algorithm
  trial := -(stiffness*stretch + damping*slidingVelocity);
  size2 := sqrt(trial*trial + Modelica.Constants.small);
  force := min(1, mu*max(normalForce, 0)/size2)*trial;
  annotation (Inline=false, Documentation(info="<html>
<p>
F<sub>t</sub> = -(S z + c v<sub>t</sub>), at most &mu; F<sub>n</sub>. While the body sticks this is a spring: the body returns when the load does, and
does not creep. Source: T. Juh&aacute;sz 2008, equations 5 to 9, with a damper added so that a body stopped does not ring.
</p>
</html>"));
end anchoredForce;
