within Modelica.Mechanics.MultiBody.Types;
type Axis = Modelica.Icons.TypeReal[3](each final unit="1") "Direction; its length does not matter"
  annotation (Documentation(info="<html><p>A vector that gives a direction. It need not have the length 1, and may not be zero.</p></html>"));
