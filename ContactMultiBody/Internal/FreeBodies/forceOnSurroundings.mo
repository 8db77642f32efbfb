within ContactMultiBody.Internal.FreeBodies;
pure function forceOnSurroundings "Contact force on the surroundings"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Force force[:, 3] "Contact force on each body, the surroundings last";
  output Modelica.Units.SI.Force surroundingsForce[3] "The last of them";
algorithm
  surroundingsForce := force[size(force, 1), :];
  annotation (Inline=false, Documentation(info="<html>
<p>In world axes.</p>
</html>"));
end forceOnSurroundings;
