within AntonWalk;
record Gait "How a tripod gait moves the feet"
  extends Modelica.Icons.Record;
  parameter Modelica.Units.SI.Time startTime=0.5 "Time of the start command";
  parameter Modelica.Units.SI.Time rampTime=1 "Time in which the legs come to full speed";
  parameter Modelica.Units.SI.Time period=1.2 "Time of a cycle at full speed";
  parameter Real dutyFactor(min=0.5, max=0.9, unit="1")=0.55 "Share of a cycle in which a foot stands; above 0.5 all six stand for a while";
  parameter Modelica.Units.SI.Length stride=0.08 "Distance of the torso while a foot stands";
  parameter Modelica.Units.SI.Angle turn=0.24 "Angle of the torso while a foot stands, where it turns on the spot";
  parameter Modelica.Units.SI.Length lift=0.035 "Height to which a foot is lifted";
  final parameter Modelica.Units.SI.Length cycleLength=stride/dutyFactor "Distance of the torso in a cycle";
  annotation (Documentation(info="<html>
<p>
Two groups of three legs take turns: front left, middle right and rear left against the others. See
<a href=\"modelica://AntonWalk.footPosition\">footPosition</a> for the path.
</p>
</html>"));
end Gait;
