within ContactMultiBody.Internal;
pure function isInertia "= true, if some body can have this tensor of inertia"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Inertia I[3, 3] "Tensor of inertia about the centre of mass, symmetric";
  output Boolean possible "= true, if each principal moment is at most the sum of the others";
protected
  Real trace "Sum of the principal moments";
  Real J[3, 3] "Integral of r*transpose(r) over the mass, by the trace: positive semidefinite for every body";
  Real minor[4] "Principal minors of J";
  constant Real eps=1e-6 "Error of the elements, by the trace";
algorithm
  trace := max(I[1, 1] + I[2, 2] + I[3, 3], Modelica.Constants.small);
  J := identity(3)*(1/2 + eps) - I/trace;
  minor := {
    J[1, 1]*J[2, 2] - J[1, 2]*J[1, 2],
    J[1, 1]*J[3, 3] - J[1, 3]*J[1, 3],
    J[2, 2]*J[3, 3] - J[2, 3]*J[2, 3],
    J[1, 1]*(J[2, 2]*J[3, 3] - J[2, 3]*J[2, 3]) - J[1, 2]*(J[1, 2]*J[3, 3] - J[1, 3]*J[2, 3])
     + J[1, 3]*(J[1, 2]*J[2, 3] - J[1, 3]*J[2, 2])};
  possible := min({J[1, 1],J[2, 2],J[3, 3]}) >= 0 and min(minor) >= 0;
  annotation (Inline=false, Documentation(info="<html>
<p>
The moments of a body are integrals over its mass, I = trace(J) identity - J, where J, the integral of r*transpose(r), is positive semidefinite. That is the
same as to say that no principal moment of inertia exceeds the sum of the other two. It holds if no principal minor of J is negative.
</p>
</html>"));
end isInertia;
