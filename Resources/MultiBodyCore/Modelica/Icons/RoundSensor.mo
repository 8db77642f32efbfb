within Modelica.Icons;
partial class RoundSensor "Icon of a round measuring instrument"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Ellipse(extent={{-70,70},{70,-70}}, lineColor={60,60,60}, fillColor={250,250,250}, fillPattern=FillPattern.Solid),
        Line(points={{-52,20},{-60,24}}, color={60,60,60}), Line(points={{0,56},{0,66}}, color={60,60,60}), Line(points={{52,20},{60,24}}, color={60,60,60}),
        Line(points={{0,0},{30,40}}, color={60,60,60}, arrow={Arrow.None,Arrow.Filled}),
        Ellipse(extent={{-6,6},{6,-6}}, lineColor={60,60,60}, fillColor={60,60,60}, fillPattern=FillPattern.Solid)}),
      Documentation(info="<html><p>The icon of sensors: a dial.</p></html>"));
end RoundSensor;
