within Modelica.Mechanics.MultiBody;
package Joints "Joints"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Connections of two frames that leave some freedom of motion.</p></html>"));
end Joints;
