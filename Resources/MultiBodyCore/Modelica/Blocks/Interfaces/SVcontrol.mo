within Modelica.Blocks.Interfaces;
partial block SVcontrol "Controller with one set point, one measurement and one output"
  extends Modelica.Blocks.Icons.Block;
  Modelica.Blocks.Interfaces.RealInput u_s "Set point"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealInput u_m "Measurement"
    annotation (Placement(transformation(extent={{20,-20},{-20,20}}, rotation=270, origin={0,-120})));
  Modelica.Blocks.Interfaces.RealOutput y "Output"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of controllers.</p></html>"));
end SVcontrol;
