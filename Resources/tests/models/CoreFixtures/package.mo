within ;
package CoreFixtures "Models that use the MultiBody core subset class by class"
  extends Modelica.Icons.ExamplesPackage;
  import Modelica.Units.SI;
  annotation (uses(Modelica(version="4.1.0")), Documentation(info="<html>
<p>Test models. Each is small enough for its motion to be known in closed form, or serves to compare two libraries.</p></html>"));
end CoreFixtures;
