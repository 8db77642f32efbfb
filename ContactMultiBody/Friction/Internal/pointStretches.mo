within ContactMultiBody.Friction.Internal;
pure function pointStretches "Stretch of the static spring of each point"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position anchor[6] "Stretch of the patch: translation (1:3), turning times radius of gyration (4:6)";
  input Real arm[:, 3](each unit="1") "Lever of each point about the centre of the patch, by the radius of gyration";
  input Real normal[size(arm, 1), 3](each unit="1") "Unit normals";
  output Modelica.Units.SI.Position stretch[size(arm, 1), 3] "Stretches, tangential";
protected
  Modelica.Units.SI.Position rigid[3] "Way of a point that moves with the patch";
algorithm
  for k in 1:size(arm, 1) loop
    rigid := {anchor[1],anchor[2],anchor[3]} + cross({anchor[4],anchor[5],anchor[6]}, arm[k, :]);
    stretch[k, :] := rigid - (rigid*normal[k, :])*normal[k, :];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>The tangential part of a rigid motion of the patch.</p>
</html>"));
end pointStretches;
