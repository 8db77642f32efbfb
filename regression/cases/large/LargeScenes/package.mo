within;
package LargeScenes "Scenes whose FMUs take minutes to build and to run"
  extends Modelica.Icons.ExamplesPackage;
  annotation (uses(Modelica(version="4.1.0"), ContactMultiBody(version="0.1.0")), Documentation(info="<html>
<p>
Run by <code>make large</code>, not with the tests.
</p>
</html>"));
end LargeScenes;
