within Modelica.Mechanics.MultiBody.Types;
type RotationSequence = Modelica.Icons.TypeInteger[3](min={1,1,1}, max={3,3,3}) "Coordinate axes of three successive rotations"
  annotation (Documentation(info="<html><p>{1,2,3} are Cardan angles, {3,1,3} Euler angles; neighbours must differ.</p></html>"));
