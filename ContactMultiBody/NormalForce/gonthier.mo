within ContactMultiBody.NormalForce;
pure function gonthier "Damping factor of Gonthier et al. (approximation)"
  extends Internal.PartialDampingFactor;
algorithm
  damping := (1 - restitution^2)/max(restitution, 0.01);
  annotation (Documentation(info="<html>
<p>Y. Gonthier, J. McPhee, C. Lange, J.-C. Piedb&oelig;uf: A regularized contact model with asymmetric damping and dwell-time dependent friction. Multibody System Dynamics 11 (2004): d = (1 - e<sup>2</sup>)/e, the approximation given there. Coefficients below 0.01 count as 0.01.</p>
</html>"));
end gonthier;
