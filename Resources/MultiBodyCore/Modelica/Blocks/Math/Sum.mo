within Modelica.Blocks.Math;
block Sum "Weighted sum of a vector"
  extends Modelica.Blocks.Interfaces.MISO;
  parameter Real k[nin]=ones(nin) "Factors";
equation
  y = k*u;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="S")}),
    Documentation(info="<html>
<p><code>y = k*u</code>.</p></html>"));
end Sum;
