within Modelica.Mechanics.MultiBody.Frames.Quaternions;
function from_T "Quaternion of a rotation matrix"
  extends Modelica.Icons.Function;
  input Real T[3, 3] "Coordinates in frame 1 to coordinates in frame 2";
  input Quaternions.Orientation Q_guess=nullRotation() "Of Q and -Q, which mean the same, the one on the side of this one is taken";
  output Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
protected
  Real d[4] = {1 + T[1, 1] - T[2, 2] - T[3, 3], 1 - T[1, 1] + T[2, 2] - T[3, 3], 1 - T[1, 1] - T[2, 2] + T[3, 3], 1 + T[1, 1] + T[2, 2] + T[3, 3]} "Four times the squares of the components";
  Real p[4] "Quaternion times four times its largest component";
algorithm
  if d[4] >= max({d[1], d[2], d[3]}) then
    p := {T[2, 3] - T[3, 2], T[3, 1] - T[1, 3], T[1, 2] - T[2, 1], d[4]};
  elseif d[1] >= max(d[2], d[3]) then
    p := {d[1], T[1, 2] + T[2, 1], T[1, 3] + T[3, 1], T[2, 3] - T[3, 2]};
  elseif d[2] >= d[3] then
    p := {T[1, 2] + T[2, 1], d[2], T[2, 3] + T[3, 2], T[3, 1] - T[1, 3]};
  else
    p := {T[1, 3] + T[3, 1], T[2, 3] + T[3, 2], d[3], T[1, 2] - T[2, 1]};
  end if;
  Q := p/sqrt(p*p);
  if Q*Q_guess < 0 then
    Q := -Q;
  end if;
  annotation (Documentation(info="<html>
<p>Sums and differences of the matrix elements are products of two components of the quaternion. Those with its largest component are taken, so that nothing is divided by a small number (S. W. Shepperd, Quaternion from rotation matrix, J. Guidance and Control 1 (1978) 223).</p></html>"));
end from_T;
