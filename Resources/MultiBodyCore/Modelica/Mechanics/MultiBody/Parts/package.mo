within Modelica.Mechanics.MultiBody;
package Parts "Bodies and rigid connections"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Rigid bodies, and frames that are fixed to each other or to the world.</p></html>"));
end Parts;
