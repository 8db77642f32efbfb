within;
package ContactMultiBody "Bodies of Modelica.Mechanics.MultiBody that collide"
  extends Modelica.Icons.Package;

  annotation (
    version="0.1.0",
    versionDate="2026-11-21",
    uses(Modelica(version="4.1.0")),
    Documentation(info="<html>
<p>
<strong>ContactMultiBody</strong> gives bodies of Modelica.Mechanics.MultiBody shapes that collide: a body carries its
geometry as a string, one <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> is connected to all
bodies that may touch, and the forces between them act where they touch.
</p>
</html>"));
end ContactMultiBody;
