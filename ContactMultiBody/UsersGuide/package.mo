within ContactMultiBody;
package UsersGuide "User's guide"
  extends Modelica.Icons.Information;

  annotation (DocumentationClass=true, Documentation(info="<html>
<p>
What the library does, how to begin, which effects and laws to choose, and what to know about numerics and tools.
</p>
</html>"));
end UsersGuide;
