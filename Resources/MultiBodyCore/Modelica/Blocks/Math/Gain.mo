within Modelica.Blocks.Math;
block Gain "Input times a constant"
  parameter Real k(start=1) "Factor";
  Modelica.Blocks.Interfaces.RealInput u "Input" annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Output" annotation (Placement(transformation(extent={{100,-10},{120,10}})));
equation
  y = k*u;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Polygon(points={{-100,-100},{-100,100},{100,0},{-100,-100}}, lineColor={0,0,160}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p><code>y = k*u</code>.</p></html>"));
end Gain;
