within Modelica.Mechanics.MultiBody.Frames;
function from_nxz "Orientation of a frame from its x-axis and a vector in its xz-plane"
  extends Modelica.Icons.Function;
  import Modelica.Math.Vectors;
  input Real n_x[3](each final unit="1") "Vector along the x-axis, in coordinates of frame 1";
  input Real n_z[3](each final unit="1") "Vector in the xz-plane on the side of the z-axis, in coordinates of frame 1";
  output Orientation R "Orientation of frame 2 with respect to frame 1";
protected
  Real e_x[3] = if Vectors.length(n_x) < 1e-10 then {1,0,0} else Vectors.normalize(n_x) "x-axis";
  Real e_z[3] = if Vectors.length(n_z) < 1e-10 then {0,0,1} else Vectors.normalize(n_z) "Direction in the xz-plane";
  Boolean parallel = cross(e_z, e_x)*cross(e_z, e_x) <= 1e-6 "= true, if the two do not span a plane";
  Real e_y[3] = Vectors.normalize(cross(if not parallel then e_z else if abs(e_x[1]) > 1e-6 then {0,0,1} else {1,0,0}, e_x)) "y-axis";
algorithm
  R := Orientation(T={e_x, e_y, cross(e_x, e_y)}, w=zeros(3));
  annotation (Documentation(info="<html>
<p>The y-axis is at right angles to both vectors, the z-axis completes the frame.</p></html>"));
end from_nxz;
