within Modelica.Mechanics.MultiBody.Types;
type ShapeExtra = Modelica.Icons.TypeReal "One more number that some shapes need"
  annotation (Documentation(info="<html><p>Shape in an animation.</p></html>"));
