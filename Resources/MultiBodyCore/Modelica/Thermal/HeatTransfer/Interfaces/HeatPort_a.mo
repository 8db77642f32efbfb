within Modelica.Thermal.HeatTransfer.Interfaces;
connector HeatPort_a "Place where heat is exchanged, filled"
  extends HeatPort;
  annotation (defaultComponentName="port_a",
    Icon(coordinateSystem(extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-80,80},{80,-80}}, lineColor={180,30,30}, fillColor={180,30,30}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html><p>The same as HeatPort_b but for the picture.</p></html>"));
end HeatPort_a;
