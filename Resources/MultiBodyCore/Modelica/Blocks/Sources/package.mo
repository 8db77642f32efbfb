within Modelica.Blocks;
package Sources "Sources of signals"
  extends Modelica.Icons.SourcesPackage;
  annotation (Documentation(info="<html><p>Signals that depend on time alone.</p></html>"));
end Sources;
