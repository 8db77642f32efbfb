within Modelica;
package Icons "Base classes that give an icon, and nothing else"
  extends Modelica.Icons.Package;
  annotation (Documentation(info="<html>
<p>Classes to extend from when only a picture is wanted. They hold no equations and no variables.</p>
</html>"));
end Icons;
