within Modelica.Mechanics.MultiBody.Types;
type VectorQuantity = enumeration(
    Force "Force",
    Torque "Torque",
    Velocity "Velocity",
    Acceleration "Acceleration",
    AngularVelocity "Angular velocity",
    AngularAcceleration "Angular acceleration",
    RelativePosition "Relative position")
  "Quantities an arrow can show"
  annotation (Documentation(info="<html><p>Choices of arrows in an animation.</p></html>"));
