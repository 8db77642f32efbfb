within Modelica.Mechanics.MultiBody.Types;
type Color = Modelica.Icons.TypeInteger[3](each min=0, each max=255) "Red, green and blue, 0 to 255"
  annotation (Documentation(info="<html><p>Colour in an animation.</p></html>"));
