within Modelica.Mechanics.MultiBody.Types;
type ShapeType = Modelica.Icons.TypeString "Kind of a shape, or the file that holds it"
  annotation (Documentation(info="<html><p>Shape in an animation: box, sphere, cylinder and so on, or a file.</p></html>"));
