within ContactMultiBody.PureModelica.Geometry;
pure function boxCorners "Corners of a box in the world"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position centre[3] "Centre of the box";
  input Real T[3, 3](each unit="1") "Rotation from the world to the box";
  input Modelica.Units.SI.Length size[3] "Full lengths";
  output Modelica.Units.SI.Position corner[8, 3] "Corners";
algorithm
  for i in 1:8 loop
    corner[i, :] := centre + (mod(i - 1, 2) - 0.5)*size[1]*T[1, :] + (mod(div(i - 1, 2), 2) - 0.5)*size[2]*T[2, :] +
      (div(i - 1, 4) - 0.5)*size[3]*T[3, :];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>The first coordinate changes fastest.</p>
</html>"));
end boxCorners;
