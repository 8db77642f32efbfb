within Modelica.Blocks.Sources;
block BooleanConstant "Boolean constant"
  parameter Boolean k=true "Value";
  extends Modelica.Blocks.Interfaces.partialBooleanSource;
equation
  y = k;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled})}),
    Documentation(info="<html>
<p>The output is <code>k</code>.</p></html>"));
end BooleanConstant;
