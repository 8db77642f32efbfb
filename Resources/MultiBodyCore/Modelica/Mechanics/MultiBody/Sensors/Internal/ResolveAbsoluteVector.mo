within Modelica.Mechanics.MultiBody.Sensors.Internal;
model ResolveAbsoluteVector "Resolves a vector in a frame that a parameter chooses"
  import Modelica.Mechanics.MultiBody.Types.ResolveInFrameA;
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameA resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_a "Frame the output is resolved in";
  input Real v_0[3] "Vector in coordinates of the world frame";
  output Real v[3] "The same vector in coordinates of the chosen frame";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame to resolve in for resolveInFrame = frame_a";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_resolve frame_resolve "Frame to resolve in for resolveInFrame = frame_resolve";
equation
  if resolveInFrame == ResolveInFrameA.world then
    v = v_0;
  elseif resolveInFrame == ResolveInFrameA.frame_a then
    v = Frames.resolve2(frame_a.R, v_0);
  else
    v = Frames.resolve2(frame_resolve.R, v_0);
  end if;
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  frame_resolve.f = zeros(3);
  frame_resolve.t = zeros(3);
  annotation (Documentation(info="<html><p>Takes no force and no torque.</p></html>"));
end ResolveAbsoluteVector;
