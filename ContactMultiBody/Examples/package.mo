within ContactMultiBody;
package Examples "Phenomena of contact, one a model"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>
Each example shows one phenomenon and says what closed-form mechanics expects of it.
</p>
</html>"));
end Examples;
