within Modelica.Thermal.HeatTransfer.Interfaces;
connector HeatPort_b "Place where heat is exchanged, open"
  extends HeatPort;
  annotation (defaultComponentName="port_b",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,80},{80,-80}}, lineColor={180,30,30}, fillColor={255,255,255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as HeatPort_a but for the picture.</p></html>"));
end HeatPort_b;
