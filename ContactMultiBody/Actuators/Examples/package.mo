within ContactMultiBody.Actuators;
package Examples "Drives at work"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>Small models whose answers are known in closed form.</p>
</html>"));
end Examples;
