within Modelica.Mechanics.MultiBody.Frames;
function to_Q "Quaternion of an orientation"
  extends Modelica.Icons.Function;
  input Orientation R "Orientation of frame 2 with respect to frame 1";
  input Quaternions.Orientation Q_guess=Quaternions.nullRotation() "Of Q and -Q, which mean the same, the one on the side of this one is taken";
  output Quaternions.Orientation Q "Quaternion";
algorithm
  Q := Quaternions.from_T(R.T, Q_guess);
  annotation (Inline=true, Documentation(info="<html>
<p>See <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Quaternions.from_T\">Quaternions.from_T</a>.</p></html>"));
end to_Q;
