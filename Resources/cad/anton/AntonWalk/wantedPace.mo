within AntonWalk;
pure function wantedPace "Rate of the cycle over the full one, as wishes and motion ask for it"
  extends Modelica.Icons.Function;
  input Real wish[2](each unit="1") "Wished shares of stride and turn";
  input Real moved[2](each unit="1") "Present shares";
  input Real free(unit="1") "Share of the swing, see freeShare";
  output Real pace(unit="1") "From 0 to 1";
protected
  Real busy(unit="1") "1 if the torso moves or shall";
algorithm
  busy := min(1, 5*max(max(abs(wish[1]), abs(wish[2])), max(abs(moved[1]), abs(moved[2]))));
  pace := busy + (1 - busy)*0.5*sqrt(free);
  annotation (Inline=false, Documentation(info="<html>
<p>A group that swings is set down, slower and slower, before the cycle stops.</p>
</html>"));
end wantedPace;
