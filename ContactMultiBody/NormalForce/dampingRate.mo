within ContactMultiBody.NormalForce;
pure function dampingRate "Damping factor by impact speed, bounded for contacts that start slowly"
  extends Modelica.Icons.Function;
  input Real damping(unit="1") "Damping factor d of the law";
  input Modelica.Units.SI.Velocity impactSpeed "Approach speed at the start of the contact";
  input Modelica.Units.SI.Velocity restSpeed(min=Modelica.Constants.small) "Below, restitution fades";
  output Real rate(unit="s/m") "d/v0";
protected
  constant Real dampingAtRest(unit="1")=20 "Damping factor for a contact that starts at rest, with restSpeed for v0";
  Real fast(unit="1") "0 for a contact that starts at rest, 1 from restSpeed on";
algorithm
  fast := min(max(impactSpeed/restSpeed, 0), 1);
  rate := (fast*damping + (1 - fast)*max(damping, dampingAtRest))/max(impactSpeed, restSpeed);
  annotation (Documentation(info="<html>
<p>
Above the rest speed the rate is d/v<sub>0</sub>, as the law says. Below it rises from d/v<sub>rest</sub> to
20/v<sub>rest</sub> and no further, so that the force stays finite when a contact starts at rest, and slow bounces die
instead of going on for ever.
</p>
</html>"));
end dampingRate;
