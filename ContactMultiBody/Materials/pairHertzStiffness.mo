within ContactMultiBody.Materials;
pure function pairHertzStiffness "Hertz's stiffness of each pair"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Stress E[:] "Modulus of elasticity of each body";
  input Modelica.Units.SI.PoissonNumber nu[size(E, 1)] "Poisson number of each body";
  input Integer pairs[:, 2] "Bodies of each pair";
  input Modelica.Units.SI.Radius radius[size(pairs, 1)] "Radius of curvature of each pair's contact";
  output Real stiffness[size(pairs, 1)] "Stiffness of each pair in N/m^1.5";
algorithm
  for i in 1:size(pairs, 1) loop
    stiffness[i] := NormalForce.hertzStiffness(E[pairs[i, 1]], nu[pairs[i, 1]], E[pairs[i, 2]], nu[pairs[i, 2]], radius[i]);
  end for;
  annotation (Inline=false, Documentation(info="<html>
<p>Applies <a href=\"modelica://ContactMultiBody.NormalForce.hertzStiffness\">hertzStiffness</a> to all pairs.</p>
</html>"));
end pairHertzStiffness;
