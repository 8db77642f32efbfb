within ContactMultiBodyTest;
package Sliding "Friction whose outcome is known in closed form"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>Blocks and spheres that slide, stick or roll.</p>
</html>"));
end Sliding;
