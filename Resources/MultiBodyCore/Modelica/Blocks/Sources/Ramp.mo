within Modelica.Blocks.Sources;
block Ramp "Ramp"
  parameter Real height=1 "Height of the ramp";
  parameter Modelica.Units.SI.Time duration(min=0.0, start=2) "Duration of the ramp; 0 for a step";
  extends Modelica.Blocks.Interfaces.SignalSource;
equation
  y = offset + (if time < startTime then 0 else if time < startTime + duration then (time - startTime)*height/duration else height);
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-30},{-30,-30},{30,50},{70,50}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output rises from <code>offset</code> at <code>startTime</code> to <code>offset + height</code> after <code>duration</code>.</p></html>"));
end Ramp;
