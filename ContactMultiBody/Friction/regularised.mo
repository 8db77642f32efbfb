within ContactMultiBody.Friction;
pure function regularised "Coulomb friction, continuous through zero speed"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force normalForce "Normal force";
  input Modelica.Units.SI.Velocity slidingVelocity[3] "Velocity of the first body against the second, tangential";
  input Real mu(min=0, unit="1") "Coefficient of friction";
  input Modelica.Units.SI.Velocity regularisationSpeed "Speed over which the force changes its direction";
  output Modelica.Units.SI.Force force[3] "Force on the first body";
algorithm
  force := -mu*normalForce/sqrt(slidingVelocity*slidingVelocity + regularisationSpeed^2)*slidingVelocity;
  annotation (Inline=false, Documentation(info="<html>
<p>
F<sub>t</sub> = -&mu; F<sub>n</sub> v<sub>t</sub>/sqrt(v<sub>t</sub><sup>2</sup> + v<sub>s</sub><sup>2</sup>). The law has no states and no
events. It cannot hold: under a load that is the share q of the largest friction force, bodies creep with
v<sub>s</sub> q/sqrt(1 - q<sup>2</sup>).
</p>
</html>"));
end regularised;
