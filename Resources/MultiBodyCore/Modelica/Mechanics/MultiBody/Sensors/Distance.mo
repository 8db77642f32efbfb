within Modelica.Mechanics.MultiBody.Sensors;
model Distance "Distance of two frames"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;
  extends Modelica.Icons.RectangularSensor;
  import Modelica.Mechanics.MultiBody.Types;
  Modelica.Blocks.Interfaces.RealOutput distance "Distance of the origins of frame_a and frame_b"
    annotation (Placement(transformation(extent={{-10,-10},{10,10}}, rotation=270, origin={0,-110})));
  parameter Boolean animation=true "= true, if an arrow is shown";
  input Types.Color arrowColor=Modelica.Mechanics.MultiBody.Types.Defaults.SensorColor "Colour of the arrow" annotation (Dialog(tab="Animation"));
  input Types.SpecularCoefficient specularCoefficient=world.defaultSpecularCoefficient "Reflection of light" annotation (Dialog(tab="Animation"));
  input SI.Position s_small(min=sqrt(Modelica.Constants.small)) = 1e-10 "Below this distance the output is smoothed" annotation (Dialog(tab="Advanced"));
protected
  SI.Position r_rel_0[3]=frame_b.r_0 - frame_a.r_0 "Position of frame_b from the origin of frame_a, in coordinates of the world frame";
  SI.Area L2=r_rel_0*r_rel_0 "Square of the distance";
equation
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  frame_b.f = zeros(3);
  frame_b.t = zeros(3);

  // Near zero a parabola in place of the root, with the same value and slope at s_small, so that the derivative stays finite
  distance = smooth(1, if noEvent(L2 > s_small^2) then sqrt(L2) else (L2/s_small + s_small)/2);
  annotation (Documentation(info="<html>
<p>Distance of the origins of frame_a and frame_b. For distances below <code>s_small</code> the output is a parabola that
continues value and slope, so that it can be differentiated everywhere.</p></html>"));
end Distance;
