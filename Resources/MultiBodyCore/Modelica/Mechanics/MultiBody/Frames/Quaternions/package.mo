within Modelica.Mechanics.MultiBody.Frames;
package Quaternions "Orientation described by unit quaternions (Euler parameters)"
  extends Modelica.Icons.FunctionsPackage;
  annotation (Documentation(info="<html>
<p>A rotation by an angle about a unit vector <code>e</code> is the quaternion
<code>Q = {e[1]*sin(angle/2), e[2]*sin(angle/2), e[3]*sin(angle/2), cos(angle/2)}</code>, of length 1; <code>Q</code> and
<code>-Q</code> mean the same rotation. Unlike three angles it is nowhere singular.</p></html>"));
end Quaternions;
