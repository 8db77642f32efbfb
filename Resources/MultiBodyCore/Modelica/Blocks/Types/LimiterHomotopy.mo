within Modelica.Blocks.Types;
type LimiterHomotopy = enumeration(
    NoHomotopy "The limiter itself",
    Linear "No limit",
    UpperLimit "The upper limit",
    LowerLimit "The lower limit")
  "What a tool may take for a limiter in a first step of initialization"
  annotation (Documentation(info="<html><p>Choices of the parameter <code>homotopyType</code> of limiters. It has no effect in this package.</p></html>"));
