within ContactMultiBody.Internal.FreeBodies;
pure function quaternionRotations "Rotation matrices of bodies from their quaternions"
  extends Modelica.Icons.Function;
  input Real Q[:, 4](each unit="1") "Quaternion of each body, not necessarily of length 1";
  output Real T[size(Q, 1), 3, 3](each unit="1") "Rotation from world to each body's frame";
protected
  Real s(unit="1") "2 by the square of a quaternion's length";
  Real x(unit="1") "First component";
  Real y(unit="1") "Second component";
  Real z(unit="1") "Third component";
  Real c(unit="1") "Fourth component, the scalar";
algorithm
  for i in 1:size(Q, 1) loop
    x := Q[i, 1];
    y := Q[i, 2];
    z := Q[i, 3];
    c := Q[i, 4];
    s := 2/(x*x + y*y + z*z + c*c);
    T[i, 1, 1] := 1 - s*(y*y + z*z);
    T[i, 1, 2] := s*(x*y + z*c);
    T[i, 1, 3] := s*(x*z - y*c);
    T[i, 2, 1] := s*(x*y - z*c);
    T[i, 2, 2] := 1 - s*(x*x + z*z);
    T[i, 2, 3] := s*(y*z + x*c);
    T[i, 3, 1] := s*(x*z + y*c);
    T[i, 3, 2] := s*(y*z - x*c);
    T[i, 3, 3] := 1 - s*(x*x + y*y);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
Quaternions as in Modelica.Mechanics.MultiBody.Frames.Quaternions: the scalar comes last. The matrix is orthonormal whatever the length of the
quaternion is.
</p>
</html>"));
end quaternionRotations;
