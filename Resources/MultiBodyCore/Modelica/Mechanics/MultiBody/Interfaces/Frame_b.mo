within Modelica.Mechanics.MultiBody.Interfaces;
connector Frame_b "Frame, open"
  extends Frame;
  annotation (defaultComponentName="frame_b",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}, initialScale=0.16), graphics={
        Rectangle(extent={{-40,100},{40,-100}}, lineColor={70,70,70}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as Frame_a but for the picture.</p></html>"));
end Frame_b;
