within;
package AntonWalk "Anton's gait, its drives, and the model that walks"
  extends Modelica.Icons.Package;

  annotation (
    version="1.0.0",
    uses(Modelica(version="4.1.0"), ContactMultiBody(version="0.1.0"), Anton(version="1.0.0")),
    Documentation(info="<html>
<p>
Written by hand; package <em>Anton</em> is generated from the CAD export and never changed. <a href=\"modelica://AntonWalk.Walk\">Walk</a>
extends its mechanics, so a new export only needs a new build.
</p>
</html>"));
end AntonWalk;
