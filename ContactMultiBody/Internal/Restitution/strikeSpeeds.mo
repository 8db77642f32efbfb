within ContactMultiBody.Internal.Restitution;
pure function strikeSpeeds "Greatest approach speed of the points where each pair touches"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length depth[:, :] "Penetration depths";
  input Modelica.Units.SI.Velocity speed[size(depth, 1), size(depth, 2)] "Approach speeds of the points";
  output Modelica.Units.SI.Velocity strikeSpeed[size(depth, 1)] "Greatest approach speed of each pair, not negative";
algorithm
  for i in 1:size(depth, 1) loop
    strikeSpeed[i] := max(max(if depth[i, k] > 0 then speed[i, k] else 0 for k in 1:size(depth, 2)), 0);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>0 for pairs that do not touch and for pairs that part.</p>
</html>"));
end strikeSpeeds;
