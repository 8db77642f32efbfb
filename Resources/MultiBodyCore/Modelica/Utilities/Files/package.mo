within Modelica.Utilities;
package Files "Names of files"
  extends Modelica.Icons.FunctionsPackage;
  annotation (Documentation(info="<html>
<p>Where a model finds the files of its package.</p>
</html>"));
end Files;
