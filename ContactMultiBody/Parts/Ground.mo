within ContactMultiBody.Parts;
model Ground "Immovable half-space or shape"
  import Modelica.Mechanics.MultiBody.Frames;
  parameter Modelica.Units.SI.Position r[3]={0,0,0} "Origin of frame_a in the world";
  parameter Real normal[3](each unit="1")={0,0,1} "Outward normal of the half-space, in world axes";
  parameter String geometry=Shapes.halfSpace(normal=normal) "Descriptor of the geometry in frame_a, see Shapes"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  final parameter Inertia inertia "Inertia, for contacts without events";
  final parameter Collider collider(
    geometry=geometry,
    material=material,
    inertia=inertia,
    isFixed=true,
    r_0=r) "All of these, for the contact manager";
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame of the ground, parallel to the world frame"
    annotation (Placement(transformation(extent={{-16,84},{16,116}})));
equation
  Connections.root(frame_a.R);
  frame_a.r_0 = r;
  frame_a.R = Frames.nullRotation();
  annotation (
    defaultComponentName="floor",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Rectangle(extent={{-100,60},{100,-60}}, lineColor={95,95,95}, fillColor={175,175,175}, fillPattern=FillPattern.Backward),
        Line(points={{-100,60},{100,60}}, color={0,0,0}, thickness=0.5),
        Line(points={{0,100},{0,60}}, color={95,95,95}),
        Text(extent={{-150,-70},{150,-110}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>
By default the half-space below the plane through r with the given normal. Any other geometry makes it a fixed shape;
<code>normal</code> then has no effect.
</p>
</html>"));
end Ground;
