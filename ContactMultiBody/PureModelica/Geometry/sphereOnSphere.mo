within ContactMultiBody.PureModelica.Geometry;
pure function sphereOnSphere "Two spheres"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position a[3] "Centre of the first sphere";
  input Modelica.Units.SI.Radius ra "Radius of the first sphere";
  input Modelica.Units.SI.Position b[3] "Centre of the second sphere";
  input Modelica.Units.SI.Radius rb "Radius of the second sphere";
  output Modelica.Units.SI.Length distance[1] "Signed distance, negative when penetrating";
  output Modelica.Units.SI.Length depth[1, 1] "Penetration depth of each point";
  output Real weight[1, 1](each unit="1") "Share of the law's force each point carries";
  output Real normal[1, 1, 3](each unit="1") "Normal of each point";
  output Modelica.Units.SI.Position point[1, 1, 3] "Contact points";
protected
  Modelica.Units.SI.Distance between "Distance of the centres";
  Real e[3](each unit="1") "Normal";
algorithm
  between := sqrt((a - b)*(a - b) + Modelica.Constants.small);
  e := (a - b)/between;
  distance[1] := between - ra - rb;
  depth[1, 1] := max(-distance[1], 0);
  weight[1, 1] := 1;
  normal[1, 1, :] := e;
  point[1, 1, :] := (a - ra*e + b + rb*e)/2;
  annotation (Inline=false, Documentation(info="<html>
<p>All other round shapes reduce to this function: their closest points are the centres.</p>
</html>"));
end sphereOnSphere;
