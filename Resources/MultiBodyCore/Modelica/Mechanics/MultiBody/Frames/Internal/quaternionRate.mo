within Modelica.Mechanics.MultiBody.Frames.Internal;
function quaternionRate "Time derivative of the quaternion of a frame that turns"
  extends Modelica.Icons.Function;
  import Modelica.Mechanics.MultiBody.Frames;
  input Frames.Quaternions.Orientation Q "Quaternion of frame 2 with respect to frame 1";
  input SI.AngularVelocity w[3] "Angular velocity of frame 2 with respect to frame 1, in coordinates of frame 2";
  output Frames.Quaternions.der_Orientation der_Q "Derivative of Q";
protected
  constant SI.DampingCoefficient rate = 1 "Rate at which an error of the length of Q fades";
algorithm
  der_Q := 0.5*cat(1, Q[4]*w + cross(Q[1:3], w), {-(Q[1:3]*w)}) + (rate/2*(1 - Q*Q))*Q;
  annotation (Inline=true, Documentation(info="<html>
<p>Half the quaternion product of <code>Q</code> and the angular velocity. Its exact solution keeps the length of <code>Q</code>; the second term, zero for the length 1, leads the length back to 1 where the integrator has changed it. It is along <code>Q</code> and so changes no orientation (compare J. Baumgarte, Comput. Methods Appl. Mech. Eng. 1 (1972) 1). All four components thus are ordinary states: no algebraic constraint, and no state selection that changes while the body turns.</p></html>"));
end quaternionRate;
