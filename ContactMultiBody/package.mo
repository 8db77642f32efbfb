within;
package ContactMultiBody "Bodies of Modelica.Mechanics.MultiBody that collide"
  extends Modelica.Icons.Package;

  annotation (
    version="0.1.0",
    versionDate="2026-11-21",
    uses(Modelica(version="4.0.0")),
    conversion(from(version="0.0.0", script="modelica://ContactMultiBody/Resources/Scripts/ConvertFromBefore0.1.0.mos")),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-50,80},{50,-20}}, lineColor={0,0,0}, fillColor={160,160,164}, fillPattern=FillPattern.Sphere),
        Rectangle(extent={{-80,-16},{80,-60}}, lineColor={0,0,0}, fillColor={0,127,255}, fillPattern=FillPattern.HorizontalCylinder),
        Line(points={{0,-16},{0,60}}, color={255,0,0}, thickness=0.5, arrow={Arrow.None,Arrow.Filled})}),
    Documentation(info="<html>
<p>
<strong>ContactMultiBody</strong> gives bodies of Modelica.Mechanics.MultiBody shapes that collide: a body carries its
geometry as a string, one <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a> is connected to all
bodies that may touch, and the forces between them act where they touch.
</p>
<p>
Begin with <a href=\"modelica://ContactMultiBody.UsersGuide.GettingStarted\">Getting started</a> and the
<a href=\"modelica://ContactMultiBody.Examples\">Examples</a>.
</p>
<p>The library works with versions 4.0.0 and 4.1.0 of the Modelica Standard Library.</p>
</html>"));
end ContactMultiBody;
