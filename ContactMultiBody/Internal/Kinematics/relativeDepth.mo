within ContactMultiBody.Internal.Kinematics;
pure function relativeDepth "Largest penetration depth of all pairs by the thickness of the thinner body"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length distance[:] "Signed distance of each pair";
  input Modelica.Units.SI.Length thickness[size(distance, 1)] "Thickness of the thinner body of each pair";
  output Real ratio(unit="1") "Largest ratio; 0 where no bodies touch";
algorithm
  ratio := 0;
  for i in 1:size(distance, 1) loop
    ratio := max(ratio, -distance[i]/thickness[i]);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>From a half on the shortest separating translation may lead to the other side of the thinner body.</p>
</html>"));
end relativeDepth;
