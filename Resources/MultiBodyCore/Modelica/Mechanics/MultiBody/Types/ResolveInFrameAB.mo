within Modelica.Mechanics.MultiBody.Types;
type ResolveInFrameAB = enumeration(
    world "World frame",
    frame_a "frame_a",
    frame_b "frame_b",
    frame_resolve "Frame connected to frame_resolve")
  "Frames a vector can be resolved in"
  annotation (Documentation(info="<html><p>Choices of forces and sensors with two frames.</p></html>"));
