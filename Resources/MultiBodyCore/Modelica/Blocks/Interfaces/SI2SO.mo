within Modelica.Blocks.Interfaces;
partial block SI2SO "Block with two inputs and one output"
  extends Modelica.Blocks.Icons.Block;
  Modelica.Blocks.Interfaces.RealInput u1 "First input"
    annotation (Placement(transformation(extent={{-140,40},{-100,80}})));
  Modelica.Blocks.Interfaces.RealInput u2 "Second input"
    annotation (Placement(transformation(extent={{-140,-80},{-100,-40}})));
  Modelica.Blocks.Interfaces.RealOutput y "Output"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of elements with two inputs and one output.</p></html>"));
end SI2SO;
