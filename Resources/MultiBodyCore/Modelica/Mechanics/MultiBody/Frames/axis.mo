within Modelica.Mechanics.MultiBody.Frames;
function axis "Unit vector of a coordinate axis"
  extends Modelica.Icons.Function;
  input Integer axis(min=1, max=3) "1, 2 or 3 for x, y or z";
  output Real e[3](each final unit="1") "Unit vector";
algorithm
  e := {if axis == 1 then 1 else 0, if axis == 2 then 1 else 0, if axis == 3 then 1 else 0};
  annotation (Inline=true, Documentation(info="<html>
<p>A column of the unit matrix.</p></html>"));
end axis;
