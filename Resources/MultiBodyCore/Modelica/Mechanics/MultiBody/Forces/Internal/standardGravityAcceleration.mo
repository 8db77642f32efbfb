within Modelica.Mechanics.MultiBody.Forces.Internal;
function standardGravityAcceleration "Uniform gravity, point gravity or none"
  extends Modelica.Icons.Function;
  extends Modelica.Mechanics.MultiBody.Interfaces.partialGravityAcceleration;
  import Modelica.Mechanics.MultiBody.Types.GravityTypes;
  input GravityTypes gravityType "Kind of gravity";
  input SI.Acceleration g[3] "Uniform gravity";
  input Real mu(unit="m3/s2") "Constant of point gravity";
algorithm
  gravity := if gravityType == GravityTypes.UniformGravity then g else if gravityType == GravityTypes.PointGravity then -mu/(r*r)*(r/
    Modelica.Math.Vectors.length(r)) else zeros(3);
  annotation (Inline=true, Documentation(info="<html>
<p>Uniform gravity is <code>g</code> everywhere, point gravity <code>mu/r^2</code> towards the origin.</p></html>"));
end standardGravityAcceleration;
