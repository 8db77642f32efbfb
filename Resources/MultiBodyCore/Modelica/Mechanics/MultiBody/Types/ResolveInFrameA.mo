within Modelica.Mechanics.MultiBody.Types;
type ResolveInFrameA = enumeration(
    world "World frame",
    frame_a "frame_a",
    frame_resolve "Frame connected to frame_resolve")
  "Frames a vector can be resolved in"
  annotation (Documentation(info="<html><p>Choices of sensors with one frame.</p></html>"));
