within ContactMultiBody.Types;
type CombinationRule = enumeration(
    Minimum "The smaller one",
    Maximum "The larger one",
    ArithmeticMean "Half the sum",
    GeometricMean "Root of the product",
    HarmonicMean "Reciprocal of the mean of the reciprocals",
    Product "The product") "How a pair gets its value from two materials"
  annotation (Documentation(info="<html>
<p>Restitution and friction belong to pairs of materials. Where only values of single materials are known, one of these rules gives the value of the pair; see <a href=\"modelica://ContactMultiBody.Materials.combine\">combine</a>.</p>
</html>"));
