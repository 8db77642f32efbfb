within Modelica.Blocks.Interfaces;
partial block SignalSource "Source with an offset that starts at a given time"
  extends Modelica.Blocks.Interfaces.SO;
  parameter Real offset=0 "Added to the output";
  parameter Modelica.Units.SI.Time startTime=0 "Before this time the output is offset";
  annotation (Documentation(info="<html><p>Base class of signals in time.</p></html>"));
end SignalSource;
