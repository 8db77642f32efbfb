within ContactMultiBody.PureModelica.Geometry;
pure function spheresOnHalfSpace "Spheres fixed to each other on a half-space"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Position centre[:, 3] "Centres";
  input Modelica.Units.SI.Radius radius "Radius of the spheres, may be zero";
  input Modelica.Units.SI.Position origin[3] "A point of the plane";
  input Real outward[3](each unit="1") "Unit normal of the plane, out of the solid";
  input Integer carrying=size(centre, 1) "Number of spheres that together carry with the whole stiffness";
  output Modelica.Units.SI.Length distance[1] "Signed distance, negative when penetrating";
  output Modelica.Units.SI.Length depth[1, size(centre, 1)] "Penetration depth of each point";
  output Real weight[1, size(centre, 1)](each unit="1") "Share of the law's force each point carries";
  output Real normal[1, size(centre, 1), 3](each unit="1") "Normal of each point";
  output Modelica.Units.SI.Position point[1, size(centre, 1), 3] "Contact points";
protected
  Modelica.Units.SI.Length height[size(centre, 1)] "Distance of each sphere";
algorithm
  for i in 1:size(centre, 1) loop
    height[i] := (centre[i, :] - origin)*outward - radius;
    depth[1, i] := max(-height[i], 0);
    weight[1, i] := 1/carrying;
    normal[1, i, :] := outward;
    point[1, i, :] := centre[i, :] - (radius + height[i]/2)*outward;
  end for;
  distance[1] := min(height);
  annotation (Inline=false, Documentation(info="<html>
<p>Each sphere is one contact point, and all carry the same share of the force. With four carrying, a box that stands on four corners is carried by the whole stiffness, on one corner by a quarter of the stiffness. With radius zero, the centres are vertices.</p>
</html>"));
end spheresOnHalfSpace;
