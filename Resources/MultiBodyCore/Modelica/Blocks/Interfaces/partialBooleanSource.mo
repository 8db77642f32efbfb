within Modelica.Blocks.Interfaces;
partial block partialBooleanSource "Source of a Boolean signal"
  extends Modelica.Blocks.Icons.Block;
  Modelica.Blocks.Interfaces.BooleanOutput y "Output"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of sources of Boolean signals.</p></html>"));
end partialBooleanSource;
