within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function from_T_inv "Quaternion of an inverse rotation matrix"
  extends Modelica.Icons.Function;
  input Real T_inv[3, 3] "Coordinates in frame 2 to coordinates in frame 1";
  input Quaternions.Orientation Q_guess=nullRotation() "Of Q and -Q, which mean the same, the one on the side of this one is taken";
  output Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
algorithm
  Q := from_T(transpose(T_inv), Q_guess);
  annotation (Documentation(info="<html>
<p>See <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Quaternions.from_T\">from_T</a>.</p></html>"));
end from_T_inv;
