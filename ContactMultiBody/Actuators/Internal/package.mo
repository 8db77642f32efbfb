within ContactMultiBody.Actuators;
package Internal "What the actuators share; not for direct use"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>The motor without its transmission, and the limit of a signal.</p>
</html>"));
end Internal;
