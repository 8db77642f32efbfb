within ContactMultiBodyTest.Laws;
model CombinationRules "Two materials combine as the rule says"
  extends Modelica.Icons.Example;
  import ContactMultiBody.Types.CombinationRule;
  import ContactMultiBody.Materials.combine;
  Real minimum[1] "Minimum";
  Real maximum[1] "Maximum";
  Real arithmetic[1] "Arithmetic mean";
  Real geometric[1] "Geometric mean";
  Real harmonic[1] "Harmonic mean";
  Real product[1] "Product";
equation
  minimum = combine({0.2,0.8}, {{1,2}}, CombinationRule.Minimum);
  maximum = combine({0.2,0.8}, {{1,2}}, CombinationRule.Maximum);
  arithmetic = combine({0.2,0.8}, {{1,2}}, CombinationRule.ArithmeticMean);
  geometric = combine({0.2,0.8}, {{1,2}}, CombinationRule.GeometricMean);
  harmonic = combine({0.2,0.8}, {{1,2}}, CombinationRule.HarmonicMean);
  product = combine({0.2,0.8}, {{1,2}}, CombinationRule.Product);
  annotation (experiment(StopTime=1, Tolerance=1e-6), Documentation(info="<html>
<p>Values 0.2 and 0.8 under each rule.</p>
</html>"));
end CombinationRules;
