within Modelica.Mechanics.MultiBody.Types;
type GravityTypes = enumeration(
    NoGravity "No gravity",
    UniformGravity "The same everywhere",
    PointGravity "Towards the origin of the world frame, with the inverse square of the distance")
  "Kinds of gravity"
  annotation (Documentation(info="<html><p>Choices of the parameter <code>gravityType</code> of the World.</p></html>"));
