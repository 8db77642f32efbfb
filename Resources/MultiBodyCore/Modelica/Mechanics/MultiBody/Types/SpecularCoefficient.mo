within Modelica.Mechanics.MultiBody.Types;
type SpecularCoefficient = Modelica.Icons.TypeReal(min=0) "Reflection of light: 0 dull, 1 shining"
  annotation (Documentation(info="<html><p>Surface in an animation.</p></html>"));
