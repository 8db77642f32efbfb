within ContactMultiBody.PureModelica;
package Geometry "Distances, depths, normals and points of pairs of simple shapes"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Each function computes one pair. Arrays have the shape the laws need: one row for the pair, one column for each point. Positions and normals are in world axes;
normals point from the second shape to the first. Points lie midway between the two surfaces.
</p>
</html>"));
end Geometry;
