within Modelica.Mechanics.MultiBody.Visualizers;
package Advanced "Shapes whose data may change"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html><p>Shapes for an animation. They are accepted, so that models need no change, and have no effect.</p></html>"));
end Advanced;
