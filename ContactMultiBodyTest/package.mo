within;
package ContactMultiBodyTest "Models that each show one property of ContactMultiBody"
  extends Modelica.Icons.ExamplesPackage;
  annotation (
    version="0.1.0",
    versionDate="2026-11-21",
    uses(Modelica(version="4.0.0"), ContactMultiBody(version="0.1.0")),
    Documentation(info="<html>
<p>Each model holds one property; its description says which, and the tests check it.</p>
</html>"));
end ContactMultiBodyTest;
