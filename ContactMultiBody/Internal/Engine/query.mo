within ContactMultiBody.Internal.Engine;
pure function query "Distances and contact points of all pairs of a scene"
  extends Modelica.Icons.Function;
  input Integer scene "Handle from intern";
  input Modelica.Units.SI.Position position[:, 3] "Origins of the bodies' frames, in world axes";
  input Real rotation[size(position, 1), 3, 3](each unit="1") "Rotation from world to each body's frame";
  input Integer pairCount "Number of pairs";
  input Integer pointCapacity "Largest number of points of a pair";
  input Modelica.Units.SI.Length exactWithin(min=Modelica.Constants.small)
    "Gap between bounding volumes up to which distances are exact";
  output Modelica.Units.SI.Length distance[pairCount]
    "Signed distance, negative when penetrating; where bounding volumes are farther apart than exactWithin a lower bound";
  output Modelica.Units.SI.Length depth[pairCount, pointCapacity] "Penetration depth of each point";
  output Real weight[pairCount, pointCapacity](each unit="1") "Share of the law's force each point carries";
  output Real normal[pairCount, pointCapacity, 3](each unit="1")
    "Unit normals from the second body to the first, in world axes";
  output Modelica.Units.SI.Position point[pairCount, pointCapacity, 3] "Contact points, in world axes";
external "C" cmb_modelica_query_within(scene, exactWithin, position, size(position, 1), rotation, pairCount, pointCapacity, distance, depth, weight, normal, point)
  annotation (
    Include="#include \"contact_multibody_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
One call for the whole scene: the result depends on the scene and the poses alone, so that an integrator may evaluate in any
order and discard steps.
</p>
</html>"));
end query;
