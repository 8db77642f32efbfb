within Modelica.Mechanics.MultiBody.Types;
type RotationTypes = enumeration(
    RotationAxis "By an axis and an angle",
    TwoAxesVectors "By two vectors of the rotated frame",
    PlanarRotationSequence "By three angles about coordinate axes")
  "Ways to say a fixed rotation"
  annotation (Documentation(info="<html><p>Choices of FixedRotation.</p></html>"));
