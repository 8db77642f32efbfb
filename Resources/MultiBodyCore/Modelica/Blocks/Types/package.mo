within Modelica.Blocks;
package Types "Types of parameters"
  extends Modelica.Icons.TypesPackage;
  annotation (Documentation(info="<html><p>Choices.</p></html>"));
end Types;
