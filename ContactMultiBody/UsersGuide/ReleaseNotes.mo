within ContactMultiBody.UsersGuide;
class ReleaseNotes "Release notes"
  extends Modelica.Icons.ReleaseNotes;
  annotation (DocumentationClass=true, Documentation(info="<html>
<h4>0.1.0</h4>
<p>First version.</p>
</html>"));
end ReleaseNotes;
