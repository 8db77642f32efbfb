within ContactMultiBody.PureModelica.Geometry;
pure function cylinderRims "Four points on each rim of a cylinder, the lowest one among them"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position centre[3] "Centre of the cylinder";
  input Real T[3, 3](each unit="1") "Rotation from the world to the cylinder";
  input Modelica.Units.SI.Radius radius "Radius";
  input Modelica.Units.SI.Length length "Length along the third axis";
  input Real outward[3](each unit="1") "Normal of the plane below";
  output Modelica.Units.SI.Position rim[8, 3] "Points";
protected
  Real u[3](each unit="1") "Direction of the lowest points";
  Real v[3](each unit="1") "Direction across";
algorithm
  u := (outward*T[3, :])*T[3, :] - outward + 1e-9*T[1, :];
  u := u/sqrt(u*u);
  v := cross(T[3, :], u);
  for i in 1:2 loop
    rim[4*i - 3, :] := centre + (i - 1.5)*length*T[3, :] + radius*u;
    rim[4*i - 2, :] := centre + (i - 1.5)*length*T[3, :] - radius*u;
    rim[4*i - 1, :] := centre + (i - 1.5)*length*T[3, :] + radius*v;
    rim[4*i, :] := centre + (i - 1.5)*length*T[3, :] - radius*v;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
For an upright cylinder the lowest point is not defined; the four points of a rim then stand in directions fixed to the cylinder. Four points
evenly spaced carry the same force and moment in whatever direction they stand, as long as all of them carry and the law is linear.
</p>
</html>"));
end cylinderRims;
