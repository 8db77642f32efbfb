within AntonWalk;
pure function footPosition "Where the gait wants a foot, against its middle position on the floor"
  extends Modelica.Icons.Function;
  input Real cycle(unit="1") "Cycles since the foot was set down, any real number";
  input Real dutyFactor(unit="1") "Share of a cycle in which the foot stands";
  input Modelica.Units.SI.Length stride "Distance backwards while the foot stands";
  input Modelica.Units.SI.Length lift "Height to which the foot is lifted";
  output Modelica.Units.SI.Position position[2] "Forward and up, seen from the torso";
protected
  constant Real pi=Modelica.Constants.pi;
  Real u(unit="1") "Share of the cycle that is over";
  Real s(unit="1") "Share of the swing that is over, 0 while the foot stands";
algorithm
  u := cycle - floor(cycle);
  s := max(0, u - dutyFactor)/(1 - dutyFactor);
  position := {stride/2 + stride/dutyFactor*(s - sin(2*pi*s)/(2*pi) - u),64*lift*(s*(1 - s))^3};
  annotation (Inline=false, Documentation(info="<html>
<p>
A standing foot goes backwards under the torso at constant speed. A swinging one covers the torso's distance of a whole cycle over the floor
as a cycloid, <code>stride/dutyFactor*(s - sin(2*pi*s)/(2*pi))</code>, and rises by <code>64*lift*(s*(1 - s))^3</code>. At lifting and
setting down, the foot's speed and acceleration against the floor are zero: the path has two continuous derivatives, and no events.
</p>
</html>"));
end footPosition;
