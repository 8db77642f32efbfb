within Modelica.Blocks.Sources;
block Step "Step"
  parameter Real height=1 "Height of the step";
  extends Modelica.Blocks.Interfaces.SignalSource;
equation
  y = offset + (if time < startTime then 0 else height);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-30},{0,-30},{0,50},{70,50}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is <code>offset</code> before <code>startTime</code> and <code>offset + height</code> from then on.</p></html>"));
end Step;
