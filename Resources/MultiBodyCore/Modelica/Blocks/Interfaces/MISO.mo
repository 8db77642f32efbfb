within Modelica.Blocks.Interfaces;
partial block MISO "Block with a vector of inputs and one output"
  extends Modelica.Blocks.Icons.Block;
  parameter Integer nin=1 "Number of inputs";
  Modelica.Blocks.Interfaces.RealInput u[nin] "Inputs"
    annotation (Placement(transformation(extent={{-140,-20},{-100,20}})));
  Modelica.Blocks.Interfaces.RealOutput y "Output"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of elements with several inputs and one output.</p></html>"));
end MISO;
