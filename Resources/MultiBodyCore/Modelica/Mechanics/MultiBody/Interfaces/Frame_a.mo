within Modelica.Mechanics.MultiBody.Interfaces;
connector Frame_a "Frame, filled"
  extends Frame;
  annotation (defaultComponentName="frame_a",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}, initialScale=0.16), graphics={
        Rectangle(extent={{-40,100},{40,-100}}, lineColor={70,70,70}, fillColor={130,150,170}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as Frame_b but for the picture.</p></html>"));
end Frame_a;
