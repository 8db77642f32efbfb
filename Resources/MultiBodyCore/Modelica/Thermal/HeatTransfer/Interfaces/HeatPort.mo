within Modelica.Thermal.HeatTransfer.Interfaces;
connector HeatPort "Place where heat is exchanged"
  Modelica.Units.SI.Temperature T "Temperature";
  flow Modelica.Units.SI.HeatFlowRate Q_flow "Heat flow into the component";
  annotation (Documentation(info="<html><p>Connected ports have one temperature; their heat flows sum to zero.</p></html>"));
end HeatPort;
