within ContactMultiBodyTest;
package Impacts "Impacts whose outcome is known in closed form"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>The speed after an impact by the speed before it, and what a published law delivers.</p>
</html>"));
end Impacts;
