within ContactMultiBody.Internal;
package Restitution "What makes contacts deliver their coefficients of restitution"
  extends Modelica.Icons.InternalPackage;

  constant Real sameStrike(unit="1")=1.25 "Approach speed by impact speed up to which a contact goes on as it began";
  constant Real newStrike(unit="1")=1.5 "The same from which on it is a strike of its own";

  annotation (Documentation(info="<html>
<p>
Damping factors, speeds of impacts, and how fast springs slow bodies down.
</p>
</html>"));
end Restitution;
