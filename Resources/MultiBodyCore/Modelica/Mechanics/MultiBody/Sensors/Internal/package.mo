within Modelica.Mechanics.MultiBody.Sensors;
package Internal "Parts of the sensors"
  extends Modelica.Icons.InternalPackage;
  annotation (Documentation(info="<html><p>Not for use in models.</p></html>"));
end Internal;
