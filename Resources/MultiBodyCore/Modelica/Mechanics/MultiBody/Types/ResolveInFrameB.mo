within Modelica.Mechanics.MultiBody.Types;
type ResolveInFrameB = enumeration(
    world "World frame",
    frame_b "frame_b",
    frame_resolve "Frame connected to frame_resolve")
  "Frames a vector can be resolved in"
  annotation (Documentation(info="<html><p>Choices of forces with one frame.</p></html>"));
