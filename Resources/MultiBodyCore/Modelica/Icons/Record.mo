within Modelica.Icons;
partial record Record "Icon of a record"
  annotation (Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-90,60},{90,-60}}, lineColor={60,60,60}, fillColor={255,250,220}, fillPattern=FillPattern.Solid),
        Line(points={{-90,20},{90,20}}, color={60,60,60}), Line(points={{-90,-20},{90,-20}}, color={60,60,60})}),
      Documentation(info="<html><p>The icon of records.</p></html>"));
end Record;
