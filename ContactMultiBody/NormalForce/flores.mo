within ContactMultiBody.NormalForce;
pure function flores "Damping factor of Flores and others"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 1.6*(1 - restitution)/max(restitution, 0.01);
  annotation (Documentation(info="<html>
<p>P. Flores, M. Machado, M. T. Silva, J. M. Martins: On the continuous contact force models for soft materials in multibody dynamics. Multibody System Dynamics 25 (2011): d = 8(1 - e)/(5e). Coefficients below 0.01 count as 0.01.</p>
</html>"));
end flores;
