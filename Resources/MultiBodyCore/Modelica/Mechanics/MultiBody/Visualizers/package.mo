within Modelica.Mechanics.MultiBody;
package Visualizers "Shapes"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Shapes for an animation. They are accepted, so that models need no change, and have no effect.</p></html>"));
end Visualizers;
