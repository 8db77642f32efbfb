within Modelica.Blocks.Interfaces;
partial block MO "Block with a vector of outputs"
  extends Modelica.Blocks.Icons.Block;
  parameter Integer nout(min=1) = 1 "Number of outputs";
  Modelica.Blocks.Interfaces.RealOutput y[nout] "Outputs"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  annotation (Documentation(info="<html><p>Base class of sources of several signals.</p></html>"));
end MO;
