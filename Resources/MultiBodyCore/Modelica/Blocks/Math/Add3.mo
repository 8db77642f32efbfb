within Modelica.Blocks.Math;
block Add3 "Weighted sum of three inputs"
  extends Modelica.Blocks.Icons.Block;
  parameter Real k1=+1 "Factor of u1";
  parameter Real k2=+1 "Factor of u2";
  parameter Real k3=+1 "Factor of u3";
  Modelica.Blocks.Interfaces.RealInput u1 "First input" annotation (Placement(transformation(extent={{-140,60},{-100,100}})));
  Modelica.Blocks.Interfaces.RealInput u2 "Second input" annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput u3 "Third input" annotation (Placement(transformation(extent={{-140,-100},{-100,-60}})));
  Modelica.Blocks.Interfaces.RealOutput y "Output" annotation (Placement(transformation(extent={{100,-10},{120,10}})));
equation
  y = k1*u1 + k2*u2 + k3*u3;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Text(extent={{-90,60},{90,-60}}, textColor={60,60,60}, textString="+")}),
    Documentation(info="<html>
<p><code>y = k1*u1 + k2*u2 + k3*u3</code>.</p></html>"));
end Add3;
