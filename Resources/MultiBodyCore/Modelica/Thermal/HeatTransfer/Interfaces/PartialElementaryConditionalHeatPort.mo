within Modelica.Thermal.HeatTransfer.Interfaces;
partial model PartialElementaryConditionalHeatPort "Component that gives off heat, with its temperature"
  parameter Boolean useHeatPort=false "= true, if the heat port exists";
  parameter Modelica.Units.SI.Temperature T=293.15 "Temperature without the heat port";
  HeatPort_a heatPort(final T=TheatPort, final Q_flow=-lossPower) if useHeatPort "Takes the heat"
    annotation (Placement(transformation(extent={{-110,-110},{-90,-90}})));
  Modelica.Units.SI.Power lossPower "Power that becomes heat";
  Modelica.Units.SI.Temperature TheatPort "Temperature";
equation
  if not useHeatPort then
    TheatPort = T;
  end if;
  annotation (Documentation(info="<html><p>Base class of elements with friction. They give <code>lossPower</code>.</p></html>"));
end PartialElementaryConditionalHeatPort;
