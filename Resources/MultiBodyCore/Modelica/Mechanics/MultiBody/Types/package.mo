within Modelica.Mechanics.MultiBody;
package Types "Types of parameters"
  extends Modelica.Icons.TypesPackage;
  annotation (Documentation(info="<html><p>Axes, sequences of rotations, choices, and the types of animation parameters.</p></html>"));
end Types;
