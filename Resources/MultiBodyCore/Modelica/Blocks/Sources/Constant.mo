within Modelica.Blocks.Sources;
block Constant "Constant"
  parameter Real k(start=1) "Value";
  extends Modelica.Blocks.Interfaces.SO;
equation
  y = k;
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-80,-80},{-80,80}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,-60},{80,-60}}, color={160,160,160}, arrow={Arrow.None,Arrow.Filled}),
        Line(points={{-80,20},{70,20}}, color={0,0,160}, thickness=0.5)}),
    Documentation(info="<html>
<p>The output is <code>k</code>.</p></html>"));
end Constant;
