within ContactMultiBody.Internal.Kinematics;
pure function deepestPair "The pair with the largest penetration depth by the thickness of its thinner body"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Length distance[:] "Signed distance of each pair";
  input Modelica.Units.SI.Length thickness[size(distance, 1)] "Thickness of the thinner body of each pair";
  output Integer deepest "Number of the pair";
protected
  Real ratio(unit="1") "Largest ratio so far";
algorithm
  deepest := 1;
  ratio := -distance[1]/thickness[1];
  for i in 2:size(distance, 1) loop
    if -distance[i]/thickness[i] > ratio then
      deepest := i;
      ratio := -distance[i]/thickness[i];
    end if;
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>For messages that name the pair; see
<a href=\"modelica://ContactMultiBody.Internal.Kinematics.relativeDepth\">relativeDepth</a>.</p>
</html>"));
end deepestPair;
