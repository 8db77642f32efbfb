within ContactMultiBody.Parts;
model CollisionShape "Gives any frame a shape that collides"
  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a "Frame the shape is fixed to"
    annotation (Placement(transformation(extent={{-116,-16},{-84,16}})));
  parameter String geometry "Descriptor of the geometry in frame_a, see Shapes" annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  parameter Inertia inertia "Inertia of what the frame belongs to, for contacts without events" annotation (Dialog(group="Contact"));
  final parameter Collider collider(geometry=geometry, material=material, inertia=inertia) "All of these, for the contact manager";
equation
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);
  annotation (
    defaultComponentName="shape",
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100,-100},{100,100}}), graphics={
        Line(points={{-100,0},{-20,0}}, color={95,95,95}),
        Rectangle(
          extent={{-40,50},{70,-50}},
          lineColor={0,0,0},
          fillColor={0,127,255},
          fillPattern=FillPattern.HorizontalCylinder,
          radius=25),
        Text(extent={{-150,110},{150,70}}, textString="%name", textColor={0,0,255})}),
    Documentation(info="<html>
<p>
A massless shape, for frames of components that have no geometry of their own: joints, arms of other libraries, fixed frames. Connect the same frame
to an element of the <a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>.
</p>
</html>"));
end CollisionShape;
