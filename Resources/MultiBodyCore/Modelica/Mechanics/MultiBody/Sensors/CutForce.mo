within Modelica.Mechanics.MultiBody.Sensors;
model CutForce "Force that passes between two frames"
  import Modelica.Mechanics.MultiBody.Types;
  Modelica.Blocks.Interfaces.RealOutput force[3](each final quantity="Force", each final unit="N") "Force at frame_a"
    annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={-80,-110})));
  parameter Boolean animation=true "= true, if an arrow is shown";
  parameter Boolean positiveSign=true "= true, if the output is the cut force of frame_a, else that of frame_b";
  extends Internal.PartialCutForceSensor;
protected
  Internal.ResolveAbsoluteVector resolveVector(v_0=Frames.resolve1(frame_a.R, cut.frame_a.f), resolveInFrame=resolveInFrame)
    "Resolves the output";
  Modelica.Mechanics.MultiBody.Interfaces.ZeroPosition zeroPosition if not resolveInFrame == Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_resolve
    "Unused frame";
equation
  force = if positiveSign then resolveVector.v else -resolveVector.v;
  connect(frame_a, resolveVector.frame_a);
  connect(frame_resolve, resolveVector.frame_resolve);
  connect(zeroPosition.frame_resolve, resolveVector.frame_resolve);
  annotation (Documentation(info="<html>
<p>The two frames coincide; the force that the component connected to frame_b takes from the one connected to frame_a is the output.</p></html>"));
end CutForce;
