within ContactMultiBody;
package Materials "Materials of bodies that collide"
  extends Modelica.Icons.MaterialPropertiesPackage;

  annotation (Documentation(info="<html>
<p>Elasticity, restitution and friction of single materials, and how two of them combine.</p>
<p>
Each record names its sources. Published coefficients of friction are those of clean, dry surfaces and of one counterpart, which the description names; films of oxide, dirt or lubricant change them by factors.
The ContactManager combines two materials by these rules unless it is given the values of the pair:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"2\">
<tr><th>value</th><th>rule</th><th>why</th></tr>
<tr><td>restitution</td><td><code>restitutionRule</code>, the smaller one</td><td>the body that loses more decides</td></tr>
<tr><td>friction, static and sliding</td><td><code>frictionRule</code>, the geometric mean</td><td>a slippery material stays slippery against a rough one, and a pair of equals keeps its value</td></tr>
<tr><td>stiffness</td><td>Hertz: 1/E* = (1 - &nu;<sub>1</sub><sup>2</sup>)/E<sub>1</sub> + (1 - &nu;<sub>2</sub><sup>2</sup>)/E<sub>2</sub></td><td>both give way in series</td></tr>
</table>
</html>"));
end Materials;
