within ContactMultiBodyTest;
package Scenes "Scenes with every part and every shape"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>That they can be built, and lie where they should.</p>
</html>"));
end Scenes;
