within ContactMultiBody.Internal;
package FreeBodies "Equations of motion of many equal free bodies"
  extends Modelica.Icons.InternalPackage;

  annotation (Documentation(info="<html>
<p>
What <a href=\"modelica://ContactMultiBody.Parts.FreeBodies\">Parts.FreeBodies</a> is made of. Where surroundings are added to free bodies, they come last.
</p>
</html>"));
end FreeBodies;
