within ContactMultiBody;
package PureModelica "Contacts of simple shapes, without any C code"
  extends Modelica.Icons.VariantsPackage;

  annotation (Documentation(info="<html>
<p>
Pairs of shapes whose distance is a formula, with the same laws, parameters and variables as the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>, but without the contact engine: they run in any Modelica tool,
also where external functions do not. Each component is one pair; frame[1] is connected to the first body its
name tells, frame[2] to the second.
</p>
</html>"));
end PureModelica;
