within ContactMultiBody.Types;
type StiffnessChoice = enumeration(
    Given "From parameter stiffness",
    Hertz "From the materials and the radius of the contact, with exponent 3/2") "Where the stiffness of a contact comes from"
  annotation (Documentation(info="<html>
<p>With <em>Hertz</em> the stiffness follows from modulus of elasticity and Poisson number of both materials and the radius of curvature; see <a href=\"modelica://ContactMultiBody.NormalForce.hertzStiffness\">hertzStiffness</a>.</p>
</html>"));
