within Modelica.Mechanics.Translational;
package Components "Elements of drive trains"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Inertias, springs, dampers, gears.</p></html>"));
end Components;
