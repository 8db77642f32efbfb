within ;
package Modelica "ContactMultiBody's MultiBody core: a small API-compatible subset for machines without the Modelica Standard Library"
  extends Modelica.Icons.Package;
  annotation (
    version="4.1.0",
    versionDate="2026-11-21",
    Documentation(info="<html>
<p>This is <strong>not</strong> the Modelica Standard Library. It is a small package that belongs to the project
ContactMultiBody and takes the library's place on machines that do not have it. Every class in it was written for
this project from the equations of mechanics; it bears the library's class, connector, parameter and variable names,
so that a model written for the Modelica Standard Library 4.1.0 that uses no other classes runs with it unchanged and
computes the same motion.</p>
<p>It holds what multibody models with joints, drives and contacts need: three-dimensional mechanics
(<a href=\"modelica://Modelica.Mechanics.MultiBody\">Mechanics.MultiBody</a>), one-dimensional drive trains
(<a href=\"modelica://Modelica.Mechanics.Rotational\">Rotational</a>,
<a href=\"modelica://Modelica.Mechanics.Translational\">Translational</a>), signal
<a href=\"modelica://Modelica.Blocks\">Blocks</a>, units and a few functions.
Animation parameters are accepted, so that models need no change, and have no effect.</p>
<p>Where the Modelica Standard Library is installed, use that one.</p>
</html>"));
end Modelica;
