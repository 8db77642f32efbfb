within Modelica.Mechanics.MultiBody.Sensors;
model AbsoluteAngularVelocity "Angular velocity of a frame"
  import Modelica.Mechanics.MultiBody.Types;
  extends Internal.PartialAbsoluteSensor;
  Modelica.Blocks.Interfaces.RealOutput w[3](each final quantity="AngularVelocity", each final unit="rad/s") "Angular velocity of frame_a"
    annotation (Placement(transformation(extent={{100,-10},{120,10}})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_resolve frame_resolve
    if resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_resolve "Frame the output is resolved in"
    annotation (Placement(transformation(extent={{-16,-116},{16,-84}})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameA resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_a "Frame the output is resolved in";
protected
  Internal.ResolveAbsoluteVector resolveVector(v_0=Frames.angularVelocity1(frame_a.R), resolveInFrame=resolveInFrame)
    "Resolves the output";
  Modelica.Mechanics.MultiBody.Interfaces.ZeroPosition zeroPosition if not resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_resolve
    "Unused frame";
equation
  w = resolveVector.v;
  connect(frame_a, resolveVector.frame_a);
  connect(frame_resolve, resolveVector.frame_resolve);
  connect(zeroPosition.frame_resolve, resolveVector.frame_resolve);
  annotation (Documentation(info="<html>
<p>Angular velocity of frame_a against the world frame. The output is resolved in the world frame, in frame_a or in the frame connected to <code>frame_resolve</code>.</p></html>"));
end AbsoluteAngularVelocity;
