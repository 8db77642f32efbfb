within ContactMultiBody.UsersGuide;
class Contact "Contact and licence"
  extends Modelica.Icons.Contact;
  annotation (DocumentationClass=true, Documentation(info="<html>
<p>
Questions and reports are welcome as issues of the project's repository; see its README.
</p>
<p>
<strong>Licence</strong>: BSD 3-clause; see the file LICENSE of the repository.
</p>
</html>"));
end Contact;
