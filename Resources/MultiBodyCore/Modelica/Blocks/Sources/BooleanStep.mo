within Modelica.Blocks.Sources;
block BooleanStep "Boolean step"
  parameter Modelica.Units.SI.Time startTime=0 "Time of the step";
  parameter Boolean startValue=false "Value before the step";
  extends Modelica.Blocks.Interfaces.partialBooleanSource;
equation
  y = if time >= startTime then not startValue else startValue;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled})}),
    Documentation(info="<html>
<p>The output changes at <code>startTime</code>.</p></html>"));
end BooleanStep;
