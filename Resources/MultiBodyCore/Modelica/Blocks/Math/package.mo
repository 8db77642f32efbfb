within Modelica.Blocks;
package Math "Mathematics"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Blocks that compute a function of their inputs.</p></html>"));
end Math;
