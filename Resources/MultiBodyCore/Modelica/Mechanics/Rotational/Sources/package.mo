within Modelica.Mechanics.Rotational;
package Sources "Sources"
  extends Modelica.Icons.SourcesPackage;
  annotation (Documentation(info="<html><p>Sources of motion and torque.</p></html>"));
end Sources;
