within ContactMultiBody.Materials;
pure function combine "Value of each pair from values of single materials"
  extends Modelica.Icons.Function;
  input Real value[:] "Value of each body's material, not negative";
  input Integer pairs[:, 2] "Bodies of each pair";
  input Types.CombinationRule rule "How two values combine";
  output Real combined[size(pairs, 1)] "Value of each pair";
algorithm
  for i in 1:size(pairs, 1) loop
    combined[i] := if rule == Types.CombinationRule.Minimum then min(value[pairs[i, 1]], value[pairs[i, 2]])
      elseif rule == Types.CombinationRule.Maximum then max(value[pairs[i, 1]], value[pairs[i, 2]])
      elseif rule == Types.CombinationRule.ArithmeticMean then (value[pairs[i, 1]] + value[pairs[i, 2]])/2
      elseif rule == Types.CombinationRule.GeometricMean then sqrt(value[pairs[i, 1]]*value[pairs[i, 2]])
      elseif rule == Types.CombinationRule.HarmonicMean then 2*value[pairs[i, 1]]*value[pairs[i, 2]]/
        max(value[pairs[i, 1]] + value[pairs[i, 2]], Modelica.Constants.small)
      else value[pairs[i, 1]]*value[pairs[i, 2]];
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>
Restitution and friction are properties of pairs, not of materials. Measured values of a pair should be given to the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> directly; the rules are for want of them.
For two bodies of the same material all rules but <em>Product</em> return the value of the material.
</p>
</html>"));
end combine;
