within Modelica.Blocks.Sources;
block RealExpression "Expression of one's own"
  Modelica.Blocks.Interfaces.RealOutput y=0.0 "Output, given by a modifier" annotation (Dialog(group="Expression"), Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,40},{100,-40}}, lineColor={0,0,160}, fillColor={240,240,240}, fillPattern=FillPattern.Solid),
        Text(extent={{-96,20},{96,-20}}, textColor={60,60,60}, textString="%y")}),
    Documentation(info="<html><p>Give the output as a modifier: <code>RealExpression source(y = 2*time)</code>.</p></html>"));
end RealExpression;
