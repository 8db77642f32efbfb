within Modelica.Thermal.HeatTransfer.Interfaces;
partial model PartialElementaryConditionalHeatPortWithoutT "Component that gives off heat, whatever its temperature"
  parameter Boolean useHeatPort=false "= true, if the heat port exists";
  HeatPort_a heatPort(final Q_flow=-lossPower) if useHeatPort "Takes the heat"
    annotation (Placement(transformation(extent={{-110,-110},{-90,-90}})));
  Modelica.Units.SI.Power lossPower "Power that becomes heat";
  annotation (Documentation(info="<html><p>Base class of elements with friction. They give <code>lossPower</code>.</p></html>"));
end PartialElementaryConditionalHeatPortWithoutT;
