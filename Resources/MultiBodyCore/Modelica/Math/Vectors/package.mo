within Modelica.Math;
package Vectors "Functions of vectors"
  extends Modelica.Icons.FunctionsPackage;
  annotation (Documentation(info="<html><p>Length and direction of vectors.</p></html>"));
end Vectors;
