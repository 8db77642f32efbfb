within Modelica.Mechanics.MultiBody.Frames;
function from_nxy "Orientation of a frame from its x-axis and a vector in its xy-plane"
  extends Modelica.Icons.Function;
  import Modelica.Math.Vectors;
  input Real n_x[3] "Vector along the x-axis, in coordinates of frame 1";
  input Real n_y[3] "Vector in the xy-plane on the side of the y-axis, in coordinates of frame 1";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
protected
  Real e_x[3] = if Vectors.length(n_x) < 1e-10 then {1,0,0} else Vectors.normalize(n_x) "x-axis";
  Real e_y[3] = if Vectors.length(n_y) < 1e-10 then {0,1,0} else Vectors.normalize(n_y) "Direction in the xy-plane";
  Boolean parallel = cross(e_x, e_y)*cross(e_x, e_y) <= 1e-6 "= true, if the two do not span a plane";
  Real e_z[3] = Vectors.normalize(cross(e_x, if not parallel then e_y else if abs(e_x[1]) > 1e-6 then {0,1,0} else {1,0,0})) "z-axis";
algorithm
  R := Orientation(T={e_x, cross(e_z, e_x), e_z}, w=zeros(3));
  annotation (Documentation(info="<html>
<p>The z-axis is at right angles to both vectors, the y-axis completes the frame. A zero vector counts as the coordinate axis of its name; if the two are parallel, the y-axis (or the x-axis, if n_x has no x component) of frame 1 takes the place of n_y.</p></html>"));
end from_nxy;
