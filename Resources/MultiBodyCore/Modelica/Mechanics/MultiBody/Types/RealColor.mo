within Modelica.Mechanics.MultiBody.Types;
type RealColor = Modelica.Icons.TypeReal[3](each min=0, each max=255) "Red, green and blue as real numbers, 0 to 255"
  annotation (Documentation(info="<html><p>Colour in an animation.</p></html>"));
