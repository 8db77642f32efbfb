within Modelica;
package Mechanics "Mechanics in one and three dimensions"
  extends Modelica.Icons.Package;
  import Modelica.Units.SI;
  annotation (Documentation(info="<html>
<p>Three-dimensional <a href=\"modelica://Modelica.Mechanics.MultiBody\">MultiBody</a> systems and one-dimensional
<a href=\"modelica://Modelica.Mechanics.Rotational\">Rotational</a> and
<a href=\"modelica://Modelica.Mechanics.Translational\">Translational</a> drive trains.</p></html>"));
end Mechanics;
