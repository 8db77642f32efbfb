within ContactMultiBody.Materials;
record Material "What a material brings into a contact"
  extends Modelica.Icons.Record;
  parameter Modelica.Units.SI.Stress E(min=Modelica.Constants.small)=1e7 "Modulus of elasticity";
  parameter Modelica.Units.SI.PoissonNumber nu(min=0, max=0.5)=0.3 "Poisson number";
  parameter Real restitution(min=0, max=1, unit="1")=0.5 "Coefficient of restitution against its like";
  parameter Real muStatic(min=0, unit="1")=0.5 "Coefficient of static friction against its like";
  parameter Real muDynamic(min=0, unit="1")=muStatic "Coefficient of sliding friction against its like";
  parameter Modelica.Units.SI.Density density(min=0)=1000 "Density; not used by contacts";
  annotation (Documentation(info="<html>
<p>
The defaults describe no real material: E = 10 MPa, as of a stiff rubber, lets contacts be computed with moderate steps.
</p>
</html>"));
end Material;
