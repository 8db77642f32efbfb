within ContactMultiBody.NormalForce.Internal;
partial function PartialDampingFactor "Interface: damping factor from restitution"
  extends Modelica.Icons.Function;
  input Real restitution(min=0, max=1, unit="1") "Coefficient of restitution";
  output Real damping(unit="1") "Damping factor d";
  annotation (Documentation(info="<html>
<p>Extended by the functions of the laws.</p>
</html>"));
end PartialDampingFactor;
