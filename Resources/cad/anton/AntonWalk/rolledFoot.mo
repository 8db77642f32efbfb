within AntonWalk;
pure function rolledFoot "Where the centre of a foot is that rolls on the floor as the shank tilts"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position foot[3] "Centre of the foot if it did not roll, against the hip";
  input Modelica.Units.SI.Angle phi[3] "Angles of the joints there";
  input Modelica.Units.SI.Angle middle[3] "Angles of the joints where the rolled distance counts from";
  input Modelica.Units.SI.Radius radius "Radius of the foot";
  output Modelica.Units.SI.Position rolled[3] "Centre of the foot";
algorithm
  rolled := foot - radius*(phi[2] + phi[3] - middle[2] - middle[3])*{cos(phi[1]),sin(phi[1]),0};
  annotation (Inline=false, Documentation(info="<html>
<p>
A ball that rolls without slipping moves by its radius times the angle. The angle is that of a shank whose foot does not roll, which
leaves out the small share radius/tibia of the distance.
</p>
</html>"));
end rolledFoot;
