within Modelica.Mechanics.MultiBody.Frames;
package Internal "Types the package Frames is built from"
  extends Modelica.Icons.InternalPackage;
  annotation (Documentation(info="<html><p>Not for use in models.</p></html>"));
end Internal;
