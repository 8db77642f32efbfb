within Modelica.Mechanics.MultiBody.Types;
type AxisLabel = Modelica.Icons.TypeString "Name of an axis"
  annotation (Documentation(info="<html><p>Label of an axis in an animation.</p></html>"));
