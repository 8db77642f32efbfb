within ContactMultiBody.NormalForce;
pure function juhasz "Damping factor of Juhasz"
  extends Internal.PartialDampingFactor;
algorithm
  damping := (1 - restitution)/max(restitution, 0.01);
  annotation (Documentation(info="<html>
<p>T. Juh&aacute;sz: Advanced Solutions in Object-Oriented Mechatronic Simulation. Budapest University of Technology and Economics, 2008, equation 4: d = (1 - e)/e. Coefficients below 0.01 count as 0.01.</p>
</html>"));
end juhasz;
