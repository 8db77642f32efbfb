within ContactMultiBody.Internal.Engine;
pure function queryVolume "Overlap of all pairs of a scene, as four points each"
  extends Modelica.Icons.Function;
  input Integer scene "Handle from intern";
  input Modelica.Units.SI.Position position[:, 3] "Origins of the bodies' frames, in world axes";
  input Real rotation[size(position, 1), 3, 3](each unit="1") "Rotation from world to each body's frame";
  input Integer pairCount "Number of pairs";
  input Modelica.Units.SI.Length exactWithin(min=Modelica.Constants.small)
    "Gap between bounding volumes up to which distances are exact";
  output Modelica.Units.SI.Length distance[pairCount]
    "Signed distance, negative when penetrating; where bounding volumes are farther apart than exactWithin a lower bound";
  output Modelica.Units.SI.Length depth[pairCount, 4] "Twice the mean depth of the overlap's volume";
  output Real weight[pairCount, 4] "A quarter of the volume of the overlap by that depth, in m2";
  output Real normal[pairCount, 4, 3](each unit="1") "Unit normals from the second body to the first, in world axes";
  output Modelica.Units.SI.Position point[pairCount, 4, 3] "Points about the centroids of the overlaps, in world axes";
external "C" cmb_modelica_query_volume_within(scene, exactWithin, position, size(position, 1), rotation, pairCount, distance, depth, weight, normal, point)
  annotation (
    Include="#include \"contact_multibody_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
The weights times depth sum to the volume, and times half the squared depth to the integral of half the squared depth over the area of contact: with exponent 1 the laws of
points become those of an elastic foundation. The points lie about the centroid as far as the second moment of the area says, so that turning is damped.
</p>
</html>"));
end queryVolume;
