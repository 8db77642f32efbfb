within Modelica.Mechanics.MultiBody;
package Frames "Orientation of coordinate systems: functions and types"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>A frame's orientation is an <a href=\"modelica://Modelica.Mechanics.MultiBody.Frames.Orientation\">Orientation</a>:
the matrix <code>T</code> that takes the coordinates of a vector in a first frame to its coordinates in a second one,
<code>v2 = T*v1</code>, and the angular velocity <code>w</code> of the second frame with respect to the first, in
coordinates of the second. They are tied by <code>der(T) = -skew(w)*T</code>. Use the functions of this package rather
than the record's components.</p>
</html>"));
end Frames;
