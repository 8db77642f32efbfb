within Modelica.Blocks.Interfaces;
partial block SO "Block with one output"
  extends Modelica.Blocks.Icons.Block;
  Modelica.Blocks.Interfaces.RealOutput y "Output"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of sources.</p></html>"));
end SO;
