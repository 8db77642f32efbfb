within Modelica.Mechanics.MultiBody.Sensors;
model RelativeAngularVelocity "Angular velocity of a frame with respect to another"
  import Modelica.Mechanics.MultiBody.Types;
  extends Internal.PartialRelativeSensor;
  Modelica.Blocks.Interfaces.RealOutput w_rel[3](each final quantity="AngularVelocity", each final unit="rad/s") "Angular velocity of frame_b with respect to frame_a"
    annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={0,-110})));
  Modelica.Mechanics.MultiBody.Interfaces.Frame_resolve frame_resolve
    if resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_resolve "Frame the output is resolved in"
    annotation (Placement(transformation(extent={{64,-116},{96,-84}})));
  parameter Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB resolveInFrame=
    Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_a "Frame the output is resolved in";
protected
  Internal.ResolveRelativeVector resolveVector(v_0=Frames.angularVelocity1(frame_b.R) - Frames.angularVelocity1(frame_a.R), resolveInFrame=resolveInFrame) "Resolves the output";
  Modelica.Mechanics.MultiBody.Interfaces.ZeroPosition zeroPosition if not resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameAB.frame_resolve
    "Unused frame";
equation
  w_rel = resolveVector.v;
  connect(frame_a, resolveVector.frame_a);
  connect(frame_b, resolveVector.frame_b);
  connect(frame_resolve, resolveVector.frame_resolve);
  connect(zeroPosition.frame_resolve, resolveVector.frame_resolve);
  annotation (Documentation(info="<html>
<p>Angular velocity of frame_b with respect to frame_a. The output is resolved in the world frame, in frame_a, in frame_b or in the frame connected to
<code>frame_resolve</code>.</p></html>"));
end RelativeAngularVelocity;
