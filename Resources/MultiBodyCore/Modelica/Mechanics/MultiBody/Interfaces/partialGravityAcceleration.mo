within Modelica.Mechanics.MultiBody.Interfaces;
partial function partialGravityAcceleration "Interface of functions that give the acceleration by gravity"
  extends Modelica.Icons.Function;
  input SI.Position r[3] "Position, from the origin of the world frame, in its coordinates";
  output SI.Acceleration gravity[3] "Acceleration by gravity there, in coordinates of the world frame";
  annotation (Documentation(info="<html><p>Functions for a field of one's own extend this one.</p></html>"));
end partialGravityAcceleration;
