within ContactMultiBody.NormalForce;
pure function leeWang "Damping factor of Lee and Wang"
  extends Internal.PartialDampingFactor;
algorithm
  damping := 0.75*(1 - restitution);
  annotation (Documentation(info="<html>
<p>T. W. Lee, A. C. Wang: On the dynamics of intermittent-motion mechanisms. Journal of Mechanisms, Transmissions, and Automation in Design 105 (1983): d = 3(1 - e)/4.</p>
</html>"));
end leeWang;
