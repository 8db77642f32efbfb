within ContactMultiBodyTest;
package Agreement "The same scene computed in two ways"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>By the library's equations and by the engine, with and without bounds for distances.</p>
</html>"));
end Agreement;
