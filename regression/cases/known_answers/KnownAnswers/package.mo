package KnownAnswers "Contact scenes whose outcome is known in closed form"
  extends Modelica.Icons.ExamplesPackage;
  annotation (uses(Modelica(version="4.1.0"), ContactMultiBody(version="0.1.0")), Documentation(info="<html>
<p>
Every model here belongs to regression cases (the TOML files beside the package) that compare it with textbook mechanics.
Gravity is 9.81 m/s2 throughout.
</p>
</html>"));
end KnownAnswers;
