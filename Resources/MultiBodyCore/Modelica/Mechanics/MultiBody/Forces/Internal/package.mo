within Modelica.Mechanics.MultiBody.Forces;
package Internal "Parts of the force elements"
  extends Modelica.Icons.InternalPackage;
  annotation (Documentation(info="<html><p>Not for use in models.</p></html>"));
end Internal;
