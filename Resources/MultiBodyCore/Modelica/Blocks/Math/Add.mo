within Modelica.Blocks.Math;
block Add "Weighted sum of two inputs"
  extends Modelica.Blocks.Interfaces.SI2SO;
  parameter Real k1=+1 "Factor of u1";
  parameter Real k2=+1 "Factor of u2";
equation
  y = k1*u1 + k2*u2;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="+")}),
    Documentation(info="<html>
<p><code>y = k1*u1 + k2*u2</code>.</p></html>"));
end Add;
