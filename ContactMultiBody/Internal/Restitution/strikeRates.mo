within ContactMultiBody.Internal.Restitution;
pure function strikeRates "How fast impact speeds follow strikes during contacts"
  extends Modelica.Icons.Function;
  import SI = Modelica.Units.SI;
  input Boolean touches[:] "= true, if the bodies of the pair touch";
  input SI.Length depth[size(touches, 1), :] "Penetration depths";
  input SI.Velocity speed[size(touches, 1), size(depth, 2)] "Approach speeds of the points";
  input SI.Velocity reachedSpeed[size(touches, 1)] "Approach speeds that strikes have reached";
  input SI.Velocity excess[size(touches, 1)] "What strikes added to the approach speeds when the contacts began";
  output SI.Acceleration rate[size(touches, 1)] "Time derivatives of the excess";
protected
  constant Real quickness(unit="1")=20 "By the share of the depth that it takes to follow";
  constant SI.Time forgetting=1e-4 "In which a strike is forgotten where bodies have parted";
  SI.Length deepest "Depth of the deepest point of a pair, not zero";
algorithm
  for i in 1:size(touches, 1) loop
    deepest := max(max(depth[i, k] for k in 1:size(depth, 2)), Modelica.Constants.small);
    rate[i] := if touches[i] then quickness*max(if depth[i, k] > 0 then max(speed[i, k] - reachedSpeed[i], 0)*speed[i, k]*depth[i, k]/
      deepest/deepest else 0 for k in 1:size(depth, 2)) else -excess[i]/forgetting;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
A contact may be struck while it lasts: by another body, by another corner, or by friction that jams. With points at depth x, approach speed dx/dt and the deepest one at x<sub>max</sub>, the excess u over the speed
v<sub>0</sub> at which the contact began, or the rest speed, grows by
</p>
<blockquote><pre>
du/dt = 20 max((dx/dt - 1.1 (v0 + u)) (dx/dt) x/x_max^2, 0),
</pre></blockquote>
<p>
so that it has followed the approach when the strike has gone a twentieth of the depth, however stiff the contact and whatever the masses. It stays zero in a contact that goes on as it began, and is forgotten
within 0.1 ms where bodies have parted.
</p>
</html>"));
end strikeRates;
