within ContactMultiBodyTest;
package Laws "Laws by themselves"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>Functions of the library against their formulas.</p>
</html>"));
end Laws;
