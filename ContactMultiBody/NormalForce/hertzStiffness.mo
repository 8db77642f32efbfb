within ContactMultiBody.NormalForce;
pure function hertzStiffness "Stiffness of Hertz's contact from the materials"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Stress E1 "Modulus of elasticity of the first body";
  input Modelica.Units.SI.PoissonNumber nu1 "Poisson number of the first body";
  input Modelica.Units.SI.Stress E2 "Modulus of elasticity of the second body";
  input Modelica.Units.SI.PoissonNumber nu2 "Poisson number of the second body";
  input Modelica.Units.SI.Radius radius "Radius of curvature of the contact, 1/(1/r1 + 1/r2)";
  output Real stiffness "Stiffness K in N/m^1.5";
algorithm
  stiffness := 4/3*sqrt(radius)/((1 - nu1^2)/E1 + (1 - nu2^2)/E2);
  annotation (Documentation(info="<html>
<p>
K = 4/3 E* sqrt(R) with 1/E* = (1 - &nu;<sub>1</sub><sup>2</sup>)/E<sub>1</sub> + (1 - &nu;<sub>2</sub><sup>2</sup>)/E<sub>2</sub>,
for exponent 3/2. Source: K. L. Johnson, Contact Mechanics, Cambridge University Press 1985, section 4.2.
</p>
</html>"));
end hertzStiffness;
