within Modelica.Blocks.Math;
block Feedback "Difference of two inputs"
  Modelica.Blocks.Interfaces.RealInput u1 "Set point" annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput u2 "Measurement" annotation (Placement(transformation(extent={{-20,-20},{20,20}}, rotation=90, origin={0,-80})));
  Modelica.Blocks.Interfaces.RealOutput y "Difference" annotation (Placement(transformation(extent={{100,-10},{120,10}})));
equation
  y = u1 - u2;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-30,30},{30,-30}}, lineColor={0,0,160}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p><code>y = u1 - u2</code>.</p></html>"));
end Feedback;
