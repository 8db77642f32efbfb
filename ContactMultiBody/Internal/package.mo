within ContactMultiBody;
package Internal "Functions and blocks that users do not call"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
Parts the public classes are made of. They may change without notice.
</p>
</html>"));
end Internal;
