within ContactMultiBody.Friction;
pure function stribeck "Coefficient of friction between static and sliding"
  extends Modelica.Icons.Function;
  input Modelica.Units.SI.Velocity speed "Sliding speed";
  input Real muStatic(min=0, unit="1") "Coefficient of static friction";
  input Real muDynamic(min=0, unit="1") "Coefficient of sliding friction";
  input Modelica.Units.SI.Velocity limitSpeed(min=Modelica.Constants.small) "Speed that separates sticking from sliding";
  output Real mu(unit="1") "Coefficient of friction";
algorithm
  mu := muDynamic + (muStatic - muDynamic)*exp(-(speed/limitSpeed)^2);
  annotation (Documentation(info="<html>
<p>
&mu; = &mu;<sub>d</sub> + (&mu;<sub>s</sub> - &mu;<sub>d</sub>) exp(-(v/v<sub>lim</sub>)<sup>2</sup>), the curve of Stribeck; it replaces
Juh&aacute;sz's switch at v<sub>lim</sub> by a smooth change.
</p>
</html>"));
end stribeck;
