within ContactMultiBody.NormalForce;
pure function huGuo "Damping factor of Hu and Guo"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 1.5*(1 - restitution)/max(restitution, 0.01);
  annotation (Documentation(info="<html>
<p>S. Hu, X. Guo: A dissipative contact force model for impact analysis in multibody dynamics. Multibody System Dynamics 35 (2015): d = 3(1 - e)/(2e). Coefficients below 0.01 count as 0.01.</p>
</html>"));
end huGuo;
