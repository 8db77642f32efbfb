within Modelica.Mechanics;
package MultiBody "Rigid bodies in space, with joints and forces"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Models of mechanisms: bodies, joints, forces and sensors that are connected by
<a href=\"modelica://Modelica.Mechanics.MultiBody.Interfaces.Frame\">frames</a>. Every model needs one
<a href=\"modelica://Modelica.Mechanics.MultiBody.World\">World</a>, declared <code>inner</code>.</p>
<p>The equations are those of Newton and Euler. Kinematic loops are allowed: tools that know Modelica's
overconstrained connections break them where they must.</p></html>"));
end MultiBody;
