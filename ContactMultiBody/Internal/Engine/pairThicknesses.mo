within ContactMultiBody.Internal.Engine;
pure function pairThicknesses "Thickness of the thinner body of each pair"
  extends Modelica.Icons.Function;
  input Integer scene "Handle from intern";
  input Integer pairCount "Number of pairs";
  output Modelica.Units.SI.Length thickness[pairCount] "Least extent of the thinnest shape; 1e9 m where no body has one";
external "C" cmb_modelica_pair_thickness(scene, pairCount, thickness)
  annotation (
    Include="#include \"contact_multibody_modelica.h\"",
    IncludeDirectory="modelica://ContactMultiBody/Resources/Include",
    LibraryDirectory="modelica://ContactMultiBody/Resources/Library",
    Library={"ContactMultiBody"});
  annotation (Documentation(info="<html>
<p>
Extents along the axes of the shapes. Half-spaces, open meshes and bodies without shape have no thickness.
</p>
</html>"));
end pairThicknesses;
