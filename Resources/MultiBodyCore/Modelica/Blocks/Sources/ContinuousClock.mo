within Modelica.Blocks.Sources;
block ContinuousClock "Time"
  extends Modelica.Blocks.Interfaces.SignalSource;
equation
  y = offset + (if time < startTime then 0 else time - startTime);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{-30,-60},{70,60}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is the time since <code>startTime</code>.</p></html>"));
end ContinuousClock;
