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
  rate := min((fast*damping + (1 - fast)*max(damping, dampingAtRest))/max(impactSpeed, restSpeed), dampingAtRest/restSpeed);
  annotation (Documentation(info="<html>
<p>
Above the rest speed the rate is d/v<sub>0</sub>, as the law says. Below it rises from d/v<sub>rest</sub> to
20/v<sub>rest</sub> and no further, so that the force stays finite when a contact starts at rest, and slow bounces die
instead of going on for ever.
</p>
<p>
The rate is 20/v<sub>rest</sub> at most. A contact damped by the rate D ends at the speed 1/D at most, so restitutions below 0.05 are delivered as long as the bodies part faster than a twentieth of
v<sub>rest</sub>; what would be slower ends at up to that speed. More damping would hardly be seen in the motion, but makes contacts stiff for as long as they last: one that is struck slowly without
restitution would follow a changing load within seconds, and its damper would act within microseconds.
</p>
</html>"));
end dampingRate;
