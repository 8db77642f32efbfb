within ContactMultiBody.Internal;
pure function isSemidefinite "= true, if a symmetric tensor has no negative principal value"
  extends Modelica.Icons.Function;
  input Real A[3, 3] "Symmetric tensor";
  output Boolean semidefinite "= true, if no principal value is negative, beyond the errors of the elements";
protected
  Real trace "Sum of the principal values";
  Real B[3, 3] "The tensor by its trace, with the errors of the elements added to the principal values";
  Real minor[4] "Principal minors of B";
  constant Real eps=2e-6 "Error of the elements, by the trace";
algorithm
  trace := max(A[1, 1] + A[2, 2] + A[3, 3], Modelica.Constants.small);
  B := A/trace + identity(3)*eps;
  minor := {
    B[1, 1]*B[2, 2] - B[1, 2]*B[1, 2],
    B[1, 1]*B[3, 3] - B[1, 3]*B[1, 3],
    B[2, 2]*B[3, 3] - B[2, 3]*B[2, 3],
    B[1, 1]*(B[2, 2]*B[3, 3] - B[2, 3]*B[2, 3]) - B[1, 2]*(B[1, 2]*B[3, 3] - B[1, 3]*B[2, 3])
     + B[1, 3]*(B[1, 2]*B[2, 3] - B[1, 3]*B[2, 2])};
  semidefinite := min({B[1, 1],B[2, 2],B[3, 3]}) >= 0 and min(minor) >= 0;
  annotation (Inline=false, Documentation(info="<html>
<p>
A tensor of inertia I has no negative principal moment. Its moments are integrals over the mass, I = trace(J) identity - J, and J, the integral of
r*transpose(r), has no negative principal value either: no principal moment of a body exceeds the sum of the other two. A symmetric tensor has
no negative principal value if none of its principal minors is negative.
</p>
</html>"));
end isSemidefinite;
