within ContactMultiBody;
package Types "Choices that decide which effects a scene has"
  extends Modelica.Icons.TypesPackage;

  annotation (Documentation(info="<html>
<p>
Enumerations of the parameters by which a <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> is told
what to compute. All of them are structural: what is not chosen leaves no equation behind.
</p>
</html>"));
end Types;
