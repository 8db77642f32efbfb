within Modelica.Blocks.Types;
type Init = enumeration(
    NoInit "Nothing; start values are guesses",
    SteadyState "The derivatives are zero",
    InitialState "The states are given",
    InitialOutput "The outputs are given")
  "Ways to initialize a block"
  annotation (Documentation(info="<html><p>Choices of the parameter <code>initType</code> of continuous blocks.</p></html>"));
