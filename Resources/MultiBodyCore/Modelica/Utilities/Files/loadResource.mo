within Modelica.Utilities.Files;
function loadResource "Name of a file that a URI means"
  extends Modelica.Icons.Function;
  input String uri "URI (modelica://Package/Resources/file), or the name of a file";
  output String fileReference "Name under which the file can be opened";
algorithm
  fileReference := uri;
  annotation (Documentation(info="<html>
<p>What this function does is the tool's own matter. The FMU builder of this project opens <code>modelica://</code> names as they
are, at translation.</p>
</html>"));
end loadResource;
