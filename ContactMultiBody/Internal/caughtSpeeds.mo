within ContactMultiBody.Internal;
pure function caughtSpeeds "Approach speeds of the contacts that start, old values of the others"
  extends Modelica.Icons.Function;
  input Boolean touches[:] "= true, if the bodies of the pair touch";
  input Boolean touched[size(touches, 1)] "= true, if they touched before the event";
  input Modelica.Units.SI.Velocity approachSpeed[size(touches, 1)] "Approach speed of each pair";
  input Modelica.Units.SI.Velocity oldSpeed[size(touches, 1)] "Speeds caught before the event";
  output Modelica.Units.SI.Velocity impactSpeed[size(touches, 1)] "Speeds caught after the event";
algorithm
  for i in 1:size(touches, 1) loop
    impactSpeed[i] := if touches[i] and not touched[i] then max(approachSpeed[i], 0) else oldSpeed[i];
  end for;
  annotation (Documentation(info="<html>
<p>Several contacts may start at one event, and not all that exist start at it.</p>
</html>"));
end caughtSpeeds;
