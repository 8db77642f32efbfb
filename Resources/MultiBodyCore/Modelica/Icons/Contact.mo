within Modelica.Icons;
partial class Contact "Icon of a class that says whom to ask"
  extends Modelica.Icons.Information;
  annotation (Documentation(info="<html><p>The icon of classes that say whom to ask.</p></html>"));
end Contact;
