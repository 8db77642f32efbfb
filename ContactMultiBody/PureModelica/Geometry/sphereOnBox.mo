within ContactMultiBody.PureModelica.Geometry;
pure function sphereOnBox "Sphere and box"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position centre[3] "Centre of the sphere in the frame of the box";
  input Modelica.Units.SI.Radius radius "Radius of the sphere";
  input Modelica.Units.SI.Length size[3] "Full lengths of the box";
  input Modelica.Units.SI.Position origin[3] "Centre of the box in the world";
  input Real T[3, 3](each unit="1") "Rotation from the world to the box";
  output Modelica.Units.SI.Length distance[1] "Signed distance, negative when penetrating";
  output Modelica.Units.SI.Length depth[1, 1] "Penetration depth of each point";
  output Real weight[1, 1](each unit="1") "Share of the law's force each point carries";
  output Real normal[1, 1, 3](each unit="1") "Normal of each point";
  output Modelica.Units.SI.Position point[1, 1, 3] "Contact points";
protected
  Modelica.Units.SI.Position q[3] "Point of the box closest to the centre";
  Modelica.Units.SI.Distance outside "Distance of the centre from the box, zero inside";
  Modelica.Units.SI.Length face[3] "Distances of the centre from the faces, negative inside";
  Modelica.Units.SI.Length nearest "Largest of these";
  Real e[3](each unit="1") "Normal in the frame of the box";
algorithm
  q := {min(max(centre[i], -size[i]/2), size[i]/2) for i in 1:3};
  outside := sqrt((centre - q)*(centre - q));
  face := {abs(centre[i]) - size[i]/2 for i in 1:3};
  nearest := max(face);
  for i in 1:3 loop
    e[i] := if outside > 0 then (centre[i] - q[i])/max(outside, Modelica.Constants.small) elseif face[i] >= nearest then (
      if centre[i] < 0 then -1 else 1) else 0;
  end for;
  e := e/sqrt(e*e);
  distance[1] := (if outside > 0 then outside else nearest) - radius;
  depth[1, 1] := max(-distance[1], 0);
  weight[1, 1] := 1;
  normal[1, 1, :] := transpose(T)*e;
  point[1, 1, :] := origin + transpose(T)*(centre - (radius + distance[1]/2)*e);
  annotation (Inline=false, Documentation(info="<html>
<p>Faces, edges and corners of the box. While the centre is outside, the normal turns continuously around edges and corners; a centre inside the box is pushed out through the nearest face.</p>
</html>"));
end sphereOnBox;
