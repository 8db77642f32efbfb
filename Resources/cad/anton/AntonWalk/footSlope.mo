within AntonWalk;
pure function footSlope "Derivative of footPosition by the cycle"
  extends Modelica.Icons.Function;
  input Real cycle(unit="1") "Cycles since the foot was set down, any real number";
  input Real dutyFactor(unit="1") "Share of a cycle in which the foot stands";
  input Modelica.Units.SI.Length stride "Distance backwards while the foot stands";
  input Modelica.Units.SI.Length lift "Height to which the foot is lifted";
  output Modelica.Units.SI.Length slope[2] "Forward and up, seen from the torso";
protected
  constant Real pi=Modelica.Constants.pi;
  Real s(unit="1") "Share of the swing that is over, 0 while the foot stands";
algorithm
  s := max(0, cycle - floor(cycle) - dutyFactor)/(1 - dutyFactor);
  slope := {stride/dutyFactor*((1 - cos(2*pi*s))/(1 - dutyFactor) - 1),192*lift*(s*(1 - s))^2*(1 - 2*s)/(1 - dutyFactor)};
  annotation (Inline=false, Documentation(info="<html>
<p>See <a href=\"modelica://AntonWalk.footPosition\">footPosition</a>.</p>
</html>"));
end footSlope;
