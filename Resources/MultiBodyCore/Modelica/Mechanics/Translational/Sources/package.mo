within Modelica.Mechanics.Translational;
package Sources "Sources"
  extends Modelica.Icons.SourcesPackage;
  annotation (Documentation(info="<html><p>Sources of motion and force.</p></html>"));
end Sources;
