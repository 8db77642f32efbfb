within ContactMultiBody.Parts;
model Fixed "Frame fixed in the world that can carry a geometry"
  extends Modelica.Mechanics.MultiBody.Parts.Fixed;
  parameter String geometry="" "Descriptor of the geometry in frame_b, see Shapes; empty: does not collide"
    annotation (Dialog(group="Contact"));
  parameter Materials.Material material "Material of the surface" annotation (Dialog(group="Contact"), choicesAllMatching=true);
  final parameter Inertia inertia "Inertia, for contacts without events";
  final parameter Collider collider(
    geometry=geometry,
    material=material,
    inertia=inertia,
    isFixed=true,
    r_0=r) "All of these, for the contact manager";
  annotation (Documentation(info="<html>
<p>
Modelica.Mechanics.MultiBody.Parts.Fixed with a geometry and a material; frame_b is connected to the
<a href=\"modelica://ContactMultiBody.ContactManager\">ContactManager</a>. See <a href=\"modelica://ContactMultiBody.Parts.Ground\">Ground</a>
for floors and walls.
</p>
</html>"));
end Fixed;
