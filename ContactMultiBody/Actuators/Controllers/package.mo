within ContactMultiBody.Actuators;
package Controllers "Controllers of motors"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>Blocks that can also be used with drives of your own.</p>
</html>"));
end Controllers;
