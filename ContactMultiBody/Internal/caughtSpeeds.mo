within ContactMultiBody.Internal;
pure function caughtSpeeds "Approach speeds of the pairs that are struck, old values of the others"
  extends Modelica.Icons.Function;
  input Boolean touches[:] "= true, if the bodies of the pair touch";
  input Boolean touched[size(touches, 1)] "= true, if they touched before the event";
  input Boolean struck[size(touches, 1)] "= true, if a touching pair is struck anew";
  input Modelica.Units.SI.Velocity strikeSpeed[size(touches, 1)] "Greatest approach speed of each pair's points";
  input Modelica.Units.SI.Velocity oldSpeed[size(touches, 1)] "Speeds caught before the event";
  output Modelica.Units.SI.Velocity impactSpeed[size(touches, 1)] "Speeds caught after the event";
algorithm
  for i in 1:size(touches, 1) loop
    impactSpeed[i] := if touches[i] and not touched[i] or struck[i] then strikeSpeed[i] else oldSpeed[i];
  end for;
  annotation (Documentation(info="<html>
<p>A pair is struck when its bodies start to touch, and anew when a point of it meets faster than when it last was struck.</p>
</html>"));
end caughtSpeeds;
